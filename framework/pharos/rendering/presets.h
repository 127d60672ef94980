#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <pharos/config/node.h>
#include <pharos/config/registry.h>

namespace pharos {

/// Returns the presets by name: the files `presets/NAME.yaml` in the folders in which the registry
/// searched for modules. If several folders have a preset of the same name, the last one counts.
std::map<std::string, std::filesystem::path> find_presets(const Registry& registry);

/// If `integrator.guiding` of a config is the name of a preset, lays the config over the preset.
/// Throws InputError if there is no such preset, or if its integrator is of another type.
void expand_preset(ConfigNode& config, const Registry& registry);

}  // namespace pharos

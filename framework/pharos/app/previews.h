#pragma once

#include <filesystem>
#include <string>

#include <pharos/config/registry.h>

namespace pharos {

/// The picture of a plugin among the previews; its file name.
std::string preview_name(const PluginInfo& plugin);

/// Renders a picture of every BSDF, emitter and shape into `folder`. The folder holds the scenes:
/// `bsdf.yaml`, `shape.yaml`, `emitter.yaml` and, for emitters that need a shape,
/// `emitter-on-shape.yaml`; in them a mapping with the key `preview` stands for the plugin, with
/// what else the mapping says. Its `settings.yaml` states by contract and name with which settings
/// a plugin is shown; others are shown with their first example or their defaults. Of samplers it
/// draws sampler_pictures(). Throws InputError.
void render_previews(const Registry& registry, const std::filesystem::path& folder);

}  // namespace pharos

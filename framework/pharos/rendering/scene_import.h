#pragma once

#include <filesystem>

#include <pharos/config/registry.h>
#include <pharos/scene/importer.h>

/// Scenes of other programs in render configs. A config may say `scene: file.xml`, or the scene
/// file may be given instead of a config. The SceneImporter named after the file's extension reads
/// it.
namespace pharos {

/// Whether there is an importer for the extension of `file`.
bool is_importable(const std::filesystem::path& file, const Registry& registry);

/// Reads a scene file of another program. Throws InputError if no importer reads such files.
Import import_scene(const std::filesystem::path& file, const Registry& registry);

/// Reads a config like read_config(). For an importable file, returns a config that only names this
/// file as its scene, and for a scene as YAML, one that also has a budget of 64 samples per pixel.
ConfigNode read_config_or_scene(const std::filesystem::path& file, const Registry& registry,
                                std::vector<std::filesystem::path>* files = nullptr);

/// Replaces an importable file that `config` names as its `scene` by the imported scene, which is a
/// base of the config. Members of `film` that the config does not state come from the file. So do
/// members of `sampler` and `integrator` if the config states no `type` or the same one, and
/// `budget` if the config does not state it at all. An integrator of another type keeps the file's
/// `max_depth` and `termination` unless it states its own. Returns notes on what was approximated.
std::vector<ImportNote> expand_import(ConfigNode& config, const Registry& registry);

}  // namespace pharos

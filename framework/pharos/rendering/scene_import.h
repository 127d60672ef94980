#pragma once

#include <filesystem>

#include <pharos/config/registry.h>
#include <pharos/scene/importer.h>

/// Scenes of other programs in render configs. A config may say `scene: file.xml`, and a scene file
/// may stand for a whole config; the importer of that name (SceneImporter) reads it.
namespace pharos {

/// Whether there is an importer for the extension of `file`.
bool is_importable(const std::filesystem::path& file, const Registry& registry);

/// Reads a scene file of another program. Throws InputError when no importer reads such files.
Import import_scene(const std::filesystem::path& file, const Registry& registry);

/// A config as read_config() reads it; a file that is importable stands for one that only names it
/// as its scene.
ConfigNode read_config_or_scene(const std::filesystem::path& file, const Registry& registry);

/// Puts the scene in place of an importable file that `config` names as its `scene`. What the
/// config does not state of `film` comes from the file, and so do `sampler`, `integrator` and
/// `budget` where it does not state them at all. Returns what was approximated.
std::vector<ImportNote> expand_import(ConfigNode& config, const Registry& registry);

}  // namespace pharos

#pragma once

#include <filesystem>
#include <string>

#include <pharos/config/registry.h>

namespace pharos {

/// Returns the file name of a plugin's picture among the previews.
std::string preview_name(const PluginInfo& plugin);

/// Renders a picture of every BSDF, emitter and shape into `folder`. The folder contains the scenes
/// `bsdf.yaml`, `shape.yaml`, `emitter.yaml` and, for emitters that need a shape,
/// `emitter-on-shape.yaml`. A mapping with the key `preview` in them is replaced by the plugin; its
/// other keys are kept. The folder's `settings.yaml` states, by contract and name, the settings
/// with which a plugin is shown. Other plugins are shown with their first example or their
/// defaults. For samplers it draws sampler_pictures(). Throws InputError.
void render_previews(const Registry& registry, const std::filesystem::path& folder);

}  // namespace pharos

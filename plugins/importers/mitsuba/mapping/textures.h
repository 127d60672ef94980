#pragma once

#include <optional>

#include "scene_map.h"

namespace pharos::mitsuba {

/// Returns the node for a texture: its name if it has an id, otherwise the texture itself.
ConfigNode map_texture(SceneMap& scene, const Object& texture, UvSense sense,
                       const Location& where);

/// Returns the average color of an image, or of a texture with constant colors. Empty for other
/// textures, and if the image is missing or has pixels that are not finite. Throws InputError if
/// the file is not an image.
std::optional<Rgb> texture_average(SceneMap& scene, const Object& texture);

}  // namespace pharos::mitsuba

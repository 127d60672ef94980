#pragma once

#include <optional>

#include "scene_map.h"

namespace pharos::mitsuba {

/// The node that stands for a texture: its name if it has an id, else the texture in place.
ConfigNode map_texture(SceneMap& scene, const Object& texture, UvSense sense,
                       const Location& where);

/// The average color of an image, or of a texture of stated colors; none for others, and where
/// the image is missing or has pixels that are not finite. Throws InputError for what is no image.
std::optional<Rgb> texture_average(SceneMap& scene, const Object& texture);

}  // namespace pharos::mitsuba

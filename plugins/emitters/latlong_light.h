#pragma once

#include <memory>

#include <pharos/core/frame.h>
#include <pharos/core/transform.h>
#include <pharos/scene/emitter.h>

#include "latlong_distribution.h"
#include "latlong_image.h"

namespace pharos {

/// Returns the unit images of the three axes under a map that rotates, mirrors and scales evenly.
/// The scale has no effect on directions. The axes are left-handed if the map mirrors. Throws
/// InputError, beginning with the name `emitter`, for any other map.
Frame turned_axes(const Transform& to_world, const char* emitter);

/// Returns an environment whose radiance is `image` times `scale`, sampled by `distribution`.
/// `axes` are the axes of the image's space in the world. Refers to `image` and `distribution`.
std::unique_ptr<const Light> latlong_light(const LatLongImage& image,
                                           const LatLongDistribution& distribution,
                                           const Frame& axes, float scale, const EmitterSite& site);

}  // namespace pharos

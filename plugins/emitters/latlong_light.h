#pragma once

#include <memory>

#include <pharos/core/frame.h>
#include <pharos/core/transform.h>
#include <pharos/scene/emitter.h>

#include "latlong_distribution.h"
#include "latlong_image.h"

namespace pharos {

/// The unit images of the three axes under a map that turns, mirrors and scales evenly; the scale
/// says nothing about directions. Left-handed where it mirrors. Throws InputError, which begins
/// with the name `emitter`, for any other map.
Frame turned_axes(const Transform& to_world, const char* emitter);

/// An environment of the radiance of `image` times `scale`, sampled by `distribution`; `axes` are
/// those of the image's space in the world. Refers to both.
std::unique_ptr<const Light> latlong_light(const LatLongImage& image,
                                           const LatLongDistribution& distribution,
                                           const Frame& axes, float scale, const EmitterSite& site);

}  // namespace pharos

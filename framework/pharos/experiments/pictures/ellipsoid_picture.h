#pragma once

#include <span>

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/density_cloud.h>
#include <pharos/guiding/contract/spatial_mixture.h>

namespace pharos {

/// How many standard deviations ellipsoids reach: a rod or a plate of even density ends there, at
/// sqrt(3) of its own.
inline constexpr float kEllipsoidReach = 1.7320508f;

/// The components of a mixture as ellipsoids over `backdrop`, all of them in front of it and half
/// transparent: the larger its weight, the brighter a component. Three channels, linear.
Image ellipsoid_picture(std::span<const SpatialGaussian> components, const CloudView& view,
                        const Image& backdrop);

/// The mixture that a model offers to a path at a point which comes from `from`, as an even
/// scatterer would ask for it; it lives in the model or in `arena`.
SpatialMixture::View mixture_for_picture(const SpatialMixture& model, Point3 point, Point3 from,
                                         Arena& arena);

}  // namespace pharos

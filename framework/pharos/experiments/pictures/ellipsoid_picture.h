#pragma once

#include <span>

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/density_cloud.h>
#include <pharos/guiding/contract/spatial_mixture.h>

namespace pharos {

/// The reach of ellipsoids [standard deviations]. A rod or a plate of even density ends at sqrt(3)
/// of its standard deviation.
inline constexpr float kEllipsoidReach = 1.7320508f;

/// Draws the components of a mixture as ellipsoids over `backdrop`, all in front of it and half
/// transparent. The larger the weight of a component, the brighter its ellipsoid. Returns three
/// linear channels.
Image ellipsoid_picture(std::span<const SpatialGaussian> components, const CloudView& view,
                        const Image& backdrop);

/// The mixture that a model offers to a path at a point which comes from `from`, as an even
/// scatterer would ask for it; it lives in the model or in `arena`.
std::span<const SpatialGaussian> mixture_for_picture(const GuidingModel& model, Point3 point,
                                                     Point3 from, Arena& arena);

}  // namespace pharos

#pragma once

#include <pharos/core/vec.h>
#include <pharos/guiding/contract/spatial_mixture.h>

/// One Gaussian as it is seen from a point, in double precision: the readable form of the
/// densities. Guiders that need speed evaluate eight components at once.
namespace pharos {

/// The density p0 of the directions from `origin` to points of a Gaussian [1/sr]; integrates to one
/// over the sphere (Lelyakin et al. 2025, eq. 2).
double exact_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction);

/// The density p1 of the same directions, those that look away from the mean turned around [1/sr]:
/// 0 where dot(direction, mean - origin) < 0, integrates to one (eq. 3). In the mean itself nothing
/// is turned around.
double flipped_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction);

/// The density of directions to points of the Gaussian's projection on the plane through its mean,
/// perpendicular to the direction there [1/sr] (Schuessler et al. 2022, section 5.2); 0 behind the
/// origin, integrates to one. Not defined in the mean itself: 0 there.
double projected_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction);

}  // namespace pharos

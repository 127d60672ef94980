#pragma once

#include <pharos/core/vec.h>
#include <pharos/guiding/contract/spatial_mixture.h>

/// The directional densities of a Gaussian as seen from a point, in double precision. This is the
/// readable form of the densities. Guiders that need speed evaluate eight components at once.
namespace pharos {

/// Returns the density p0 [1/sr] of the directions from `origin` to points of a Gaussian. It
/// integrates to one over the sphere (Lelyakin et al. 2025, eq. 2).
double exact_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction);

/// Returns the density p1 [1/sr] of the same directions after those that point away from the mean
/// have been reversed. It is 0 if dot(direction, mean - origin) < 0 and integrates to one (eq. 3).
/// If `origin` is the mean, no direction is reversed.
double flipped_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction);

/// Returns the density [1/sr] of the directions to points of the Gaussian's projection onto a plane
/// (Schuessler et al. 2022, section 5.2). The plane passes through the mean, perpendicular to the
/// direction from `origin` to the mean. The density is 0 behind the origin and integrates to one.
/// If `origin` is the mean, the density is not defined and the function returns 0.
double projected_density(const SpatialGaussian& gaussian, Point3 origin, Vec3 direction);

}  // namespace pharos

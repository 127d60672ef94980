#pragma once

#include <array>
#include <optional>

#include <pharos/core/bounds.h>
#include <pharos/core/transform.h>

#include "double3.h"

/// What the exact round shapes share.
namespace pharos {

/// The factor of a map that keeps angles (rotations, translations, mirrors, even scales); empty for
/// others.
std::optional<float> even_scale(const Transform& map);

/// Both parameters t, ascending, at which `origin + t * direction` is `radius` away from zero;
/// empty when there are none. The direction need not be unit.
std::optional<std::array<double, 2>> distance_roots(Double3 origin, Double3 direction,
                                                    double radius);

/// The angle of (x, y) from +x towards +y as a fraction of the full turn, in [0, 1].
float azimuth_fraction(float x, float y);

/// The box of all points that are at most `reach` away from `center` along each axis, rounded
/// outwards.
Bounds3 bounds_around(Point3 center, Vec3 reach);

/// A bound on the error of an exact shape's points (SurfacePoint::error) when no coordinate of its
/// surface exceeds `coordinate` [scene units].
float exact_shape_error(float coordinate);

}  // namespace pharos

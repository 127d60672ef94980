#pragma once

#include <array>
#include <optional>

#include <pharos/core/bounds.h>
#include <pharos/core/transform.h>

#include "double3.h"

/// Functions that the exact round shapes share.
namespace pharos {

/// Returns the scale factor of a map that preserves angles (rotations, translations, mirrors,
/// uniform scales); empty for other maps.
std::optional<float> even_scale(const Transform& map);

/// Returns both parameters t, ascending, for which `origin + t * direction` has the distance
/// `radius` from zero; empty if there are none. The direction need not have unit length.
std::optional<std::array<double, 2>> distance_roots(Double3 origin, Double3 direction,
                                                    double radius);

/// Returns the angle of (x, y) from +x towards +y as a fraction of the full turn, in [0, 1].
float azimuth_fraction(float x, float y);

/// Returns the box of all points at most `reach` away from `center` along each axis, rounded
/// outwards.
Bounds3 bounds_around(Point3 center, Vec3 reach);

/// Returns a bound on the error of an exact shape's points (SurfacePoint::error) if no coordinate
/// of its surface exceeds `coordinate` [scene units].
float exact_shape_error(float coordinate);

}  // namespace pharos

#pragma once

#include <pharos/core/bounds.h>

namespace pharos {

/// The farthest that anything in a scene may lie from the origin, along each axis [scene units].
/// Products of four lengths are then in the range of a float.
inline constexpr float kFarthest = 1e9f;

/// Throws InputError if `point`, the place of `what`, is too far from the origin or not finite.
void check_reach(Point3 point, const char* what);
/// Does the same for the corners of a box, unless it is empty.
void check_reach(const Bounds3& box, const char* what);

}  // namespace pharos

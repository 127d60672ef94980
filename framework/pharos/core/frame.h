#pragma once

#include <cmath>

#include <pharos/core/vec.h>

namespace pharos {

/// An orthonormal right-handed frame. The local z axis is the normal.
struct Frame {
  Vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

  /// Returns a frame around the unit normal `n`. The axes s and t are arbitrary, and they jump
  /// where n.z changes its sign (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
  static Frame from_normal(Vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  /// Returns the frame around the unit normal `n` whose s is as close as possible to `tangent`,
  /// which may have any length. Returns from_normal(n) if the two are parallel, or if the tangent
  /// is zero or not finite.
  static Frame along(Vec3 n, Vec3 tangent) {
    const Vec3 s = tangent - dot(tangent, n) * n;
    // Uses double precision, because the squares may exceed the range of a float.
    const double size = std::hypot(double{s.x}, double{s.y}, double{s.z});
    if (!(size > 0) || !std::isfinite(size)) return from_normal(n);
    const Vec3 unit{static_cast<float>(s.x / size), static_cast<float>(s.y / size),
                    static_cast<float>(s.z / size)};
    return {unit, cross(n, unit), n};
  }

  Vec3 to_local(Vec3 v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vec3 to_world(Vec3 v) const { return v.x * s + v.y * t + v.z * n; }
};

/// Returns the signed cosine between a local direction and the normal.
constexpr float cos_theta(Vec3 local) {
  return local.z;
}

}  // namespace pharos

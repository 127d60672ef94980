#pragma once

#include <algorithm>

#include <pharos/core/bounds.h>

namespace pharos::stubs {

/// The distances at which a ray is inside a box, clamped to its start. Empty if end <= begin.
struct Interval {
  double begin = 0, end = 0;
};

inline Interval box_interval(const Bounds3& box, Point3 origin, Vec3 direction) {
  Interval t{0, kInfinity};
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    double near = (double{box.low[axis]} - origin[axis]) / d;
    double far = (double{box.high[axis]} - origin[axis]) / d;
    if (near > far) std::swap(near, far);
    t.begin = std::max(t.begin, near);
    t.end = std::min(t.end, far);
  }
  return t;
}

/// Returns the density [1/sr] of the direction from `origin` to a point drawn uniformly from the
/// box. It is the integral of t^2 / volume along the ray.
inline double box_direction_pdf(const Bounds3& box, Point3 origin, Vec3 direction) {
  const Interval t = box_interval(box, origin, direction);
  if (!(t.end > t.begin)) return 0;
  const Vec3 e = box.extent();
  const double volume = double{e.x} * e.y * e.z;
  return (t.end - t.begin) * (t.end * t.end + t.end * t.begin + t.begin * t.begin) / (3 * volume);
}

}  // namespace pharos::stubs

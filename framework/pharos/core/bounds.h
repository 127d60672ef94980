#pragma once

#include <pharos/core/vec.h>

namespace pharos {

/// An axis-aligned box [scene units]. It is empty until a point or a box is added.
struct Bounds3 {
  Point3 low{kInfinity, kInfinity, kInfinity};
  Point3 high{-kInfinity, -kInfinity, -kInfinity};

  bool empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
  Vec3 extent() const { return high - low; }
  Point3 center() const { return 0.5f * (low + high); }
  /// Returns the length of the diagonal [scene units], or 0 if the box is empty.
  float diagonal() const { return empty() ? 0.0f : length(extent()); }
  bool contains(Point3 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
           p.z <= high.z;
  }
  void add(Point3 p) {
    low = min(low, p);
    high = max(high, p);
  }
  void add(const Bounds3& b) {
    low = min(low, b.low);
    high = max(high, b.high);
  }
};

}  // namespace pharos

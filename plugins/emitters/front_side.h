#pragma once

#include <cmath>

#include <pharos/scene/shape.h>

namespace pharos {

/// The half-space in front of a flat shape, from which its outer side can be seen. Other shapes
/// have none.
class FrontSide {
 public:
  explicit FrontSide(const Shape& shape);

  /// Returns whether a point is so far behind a flat shape that it sees no point of the outer side,
  /// in spite of rounding errors. Returns false for shapes that are not flat.
  bool excludes(Point3 from) const {
    constexpr float kRounding = 2e-6f;  // relative error of directions and normals
    const Vec3 way = from - point_;
    const float reach = std::abs(way.x) + std::abs(way.y) + std::abs(way.z);
    return dot(way, normal_) < -(error_ + kRounding * reach);
  }

 private:
  Point3 point_;     ///< in the plane of the shape
  Vec3 normal_;      ///< unit; zero if the shape is not flat
  float error_ = 0;  ///< largest distance of the shape from the plane [scene units]
};

}  // namespace pharos

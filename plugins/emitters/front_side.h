#pragma once

#include <cmath>

#include <pharos/scene/shape.h>

namespace pharos {

/// The half-space in front of a flat triangle mesh, from which its outer side can be seen. Other
/// shapes have none.
class FrontSide {
 public:
  explicit FrontSide(const Shape& shape);

  /// Returns whether a point is so far behind a flat mesh that it sees no point of the outer side,
  /// in spite of rounding errors. Returns false for other shapes.
  bool excludes(Point3 from) const {
    const Vec3 way = from - point_;
    return dot(way, normal_) < -(error_ + rounding(way));
  }

 private:
  /// Bounds the error of a distance from the plane that is computed at this place relative to
  /// `point_`. It comes from the rounding of directions and from the differences between normals.
  static float rounding(Vec3 way) {
    constexpr float kRelative = 2e-6f;
    return kRelative * (std::abs(way.x) + std::abs(way.y) + std::abs(way.z));
  }

  Point3 point_;     ///< in the plane of the mesh
  Vec3 normal_;      ///< unit; zero if the shape is not a flat mesh
  float error_ = 0;  ///< bounds the distance of its points from the plane [scene units]
};

}  // namespace pharos

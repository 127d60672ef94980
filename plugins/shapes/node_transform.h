#pragma once

#include "double3.h"

namespace pharos {

/// An affine map from a node's space to another space, in double precision, for points, normals and
/// orientation. It need not be invertible.
class NodeTransform {
 public:
  /// The identity.
  NodeTransform() : NodeTransform({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}) {}
  /// Maps the axes, as vectors, and the origin to the given images.
  NodeTransform(Double3 x, Double3 y, Double3 z, Double3 origin)
      : x_(x),
        y_(y),
        z_(z),
        origin_(origin),
        yz_(cross(y, z)),
        zx_(cross(z, x)),
        xy_(cross(x, y)),
        mirrors_(dot(x, yz_) < 0) {}

  /// Maps a point and rounds it once.
  Point3 point(Point3 p) const { return Point3(apply(Double3(p)) + origin_); }
  /// Maps a normal to unit length, or to zero if the map makes it vanish. It uses the cofactors,
  /// which equal the inverse transpose times the determinant and also exist for maps that flatten
  /// space.
  Vec3 normal(Vec3 n) const {
    const Double3 v = n.x * yz_ + n.y * zx_ + n.z * xy_;
    const double size = length(v);
    return size > 0 ? Vec3((mirrors_ ? -1 / size : 1 / size) * v) : Vec3{};
  }
  bool mirrors() const { return mirrors_; }

  /// `outer * inner` applies `inner` first.
  friend NodeTransform operator*(const NodeTransform& outer, const NodeTransform& inner) {
    return {outer.apply(inner.x_), outer.apply(inner.y_), outer.apply(inner.z_),
            outer.apply(inner.origin_) + outer.origin_};
  }

 private:
  Double3 apply(Double3 v) const { return v.x * x_ + v.y * y_ + v.z * z_; }

  Double3 x_, y_, z_, origin_;
  Double3 yz_, zx_, xy_;  ///< cross products of the axes
  bool mirrors_;
};

}  // namespace pharos

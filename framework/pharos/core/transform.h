#pragma once

#include <array>

#include <pharos/core/vec.h>

namespace pharos {

/// An invertible affine map from local to world space, with its inverse. Matrices are row-major
/// 3x4: columns 0-2 are the linear part, column 3 is the translation.
class Transform {
 public:
  using Matrix = std::array<std::array<float, 4>, 3>;

  /// The identity.
  Transform();
  /// Makes the affine map of `matrix`. Throws InputError if the matrix cannot be inverted.
  explicit Transform(const Matrix& matrix);

  static Transform translate(Vec3 offset);
  static Transform scale(Vec3 factors);
  /// Rotates counter-clockwise about `axis` by `degrees`. The axis may have any length.
  static Transform rotate(Vec3 axis, float degrees);
  /// Maps local +z towards `target`, local +y near to `up`, and the local origin to `origin`. The
  /// map is right-handed, with +x to the left of the viewer. Throws InputError if the three
  /// arguments do not span a frame.
  static Transform look_at(Point3 origin, Point3 target, Vec3 up);

  Point3 point(Point3 p) const { return apply(forward_, p) + column(forward_, 3); }
  Vec3 vector(Vec3 v) const { return apply(forward_, v); }
  /// Maps a normal (inverse transpose); the result is not normalized.
  Vec3 normal(Vec3 n) const;
  Point3 inverse_point(Point3 p) const { return apply(inverse_, p) + column(inverse_, 3); }
  Vec3 inverse_vector(Vec3 v) const { return apply(inverse_, v); }

  /// Returns true if the map mirrors (negative determinant).
  bool flips_handedness() const;
  const Matrix& matrix() const { return forward_; }

  /// `a * b` applies b first.
  friend Transform operator*(const Transform& a, const Transform& b);

 private:
  static Vec3 column(const Matrix& m, int c) { return {m[0][c], m[1][c], m[2][c]}; }
  static Vec3 apply(const Matrix& m, Vec3 v) {
    return v.x * column(m, 0) + v.y * column(m, 1) + v.z * column(m, 2);
  }

  Matrix forward_;
  Matrix inverse_;
};

}  // namespace pharos

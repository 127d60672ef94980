#pragma once

#include <cmath>

#include <pharos/core/vec.h>

namespace pharos {

/// Three doubles, for the steps of exact shapes in which float would lose the precision of the
/// scene's coordinates.
struct Double3 {
  double x = 0, y = 0, z = 0;

  constexpr Double3() = default;
  constexpr Double3(double a, double b, double c) : x(a), y(b), z(c) {}
  explicit constexpr Double3(Vec3 v) : x(v.x), y(v.y), z(v.z) {}

  /// Rounds each component once.
  explicit constexpr operator Vec3() const {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  }

  friend constexpr Double3 operator+(Double3 a, Double3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Double3 operator-(Double3 a, Double3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Double3 operator*(double s, Double3 v) { return {s * v.x, s * v.y, s * v.z}; }
};

constexpr double dot(Double3 a, Double3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Double3 cross(Double3 a, Double3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Double3 v) {
  return std::sqrt(dot(v, v));
}
inline Double3 normalize(Double3 v) {
  return (1 / length(v)) * v;
}

}  // namespace pharos

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// The largest float below one. Primary numbers lie in [0, kOneMinusEpsilon].
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

/// Two floats: primary numbers, texture coordinates or film positions.
struct Vec2 {
  float x = 0, y = 0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(float s, Vec2 v) { return {s * v.x, s * v.y}; }
  friend constexpr Vec2 operator*(Vec2 v, float s) { return s * v; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

/// Three floats in world or local space [scene units; directions have no unit].
struct Vec3 {
  float x = 0, y = 0, z = 0;

  constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3& operator+=(Vec3 v) { return *this = *this + v; }

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(float s, Vec3 v) { return {s * v.x, s * v.y, s * v.z}; }
  friend constexpr Vec3 operator*(Vec3 v, float s) { return s * v; }
  friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec3 operator/(Vec3 v, float s) { return (1 / s) * v; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

/// A Vec3 that holds a position. Signatures use this name to distinguish positions from directions.
using Point3 = Vec3;

constexpr float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr float abs_dot(Vec3 a, Vec3 b) {
  const float d = dot(a, b);
  return d < 0 ? -d : d;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr float length_squared(Vec3 v) {
  return dot(v, v);
}
inline float length(Vec3 v) {
  return std::sqrt(length_squared(v));
}
inline Vec3 normalize(Vec3 v) {
  return v / length(v);
}
constexpr Vec3 min(Vec3 a, Vec3 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
constexpr Vec3 max(Vec3 a, Vec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
inline Vec3 abs(Vec3 v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}
constexpr float max_component(Vec3 v) {
  return std::max(v.x, std::max(v.y, v.z));
}
inline bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
constexpr float square(float v) {
  return v * v;
}
/// Returns the square root, treating small negative values from rounding as zero.
inline float safe_sqrt(float v) {
  return std::sqrt(std::max(0.0f, v));
}
constexpr float lerp(float a, float b, float t) {
  return (1 - t) * a + t * b;
}
constexpr float radians(float degrees) {
  return degrees * (kPi / 180);
}

}  // namespace pharos

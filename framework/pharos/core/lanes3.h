#pragma once

#include <array>

#include <pharos/core/simd.h>
#include <pharos/core/vec.h>

namespace pharos {

/// Vectors side by side, one in each lane. `Number` is a SIMD vector such as Float8.
template <class Number>
struct Lanes3 {
  Number x, y, z;

  friend Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Lanes3 operator*(const Number& factor, const Lanes3& v) {
    return {factor * v.x, factor * v.y, factor * v.z};
  }
};

template <class Number>
Number dot(const Lanes3<Number>& a, const Lanes3<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
Lanes3<Number> cross(const Lanes3<Number>& a, const Lanes3<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns one vector in all lanes.
inline Lanes3<Float8> all8(Vec3 v) {
  return {all8(v.x), all8(v.y), all8(v.z)};
}

/// Returns the vector of one lane.
inline Vec3 lane_of(const Lanes3<Float8>& v, unsigned lane) {
  return {v.x[lane], v.y[lane], v.z[lane]};
}

/// Returns two unit vectors perpendicular to the unit vectors `n` and to each other (Duff et al.
/// 2017).
inline std::array<Lanes3<Float8>, 2> perpendicular(const Lanes3<Float8>& n) {
  const Float8 one = all8(1), sign = n.z < 0 ? -one : one;
  const Float8 a = -one / (sign + n.z), b = n.x * n.y * a;
  return {Lanes3<Float8>{one + sign * n.x * n.x * a, sign * b, -sign * n.x},
          Lanes3<Float8>{b, sign + n.y * n.y * a, -n.y}};
}

}  // namespace pharos

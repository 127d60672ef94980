#pragma once

#include <cstddef>

#include <pharos/core/simd.h>
#include <pharos/core/vec.h>

/// Eight lobes side by side.
namespace pharos::parallax_aware_mixtures {

inline constexpr std::size_t kLanes = 8;

/// Returns |a - w|^2. For unit vectors this is 2 (1 - cos) and keeps the digits of small angles.
inline Float8 squared_distance(const Float8 (&a)[3], Vec3 w) {
  const Float8 x = a[0] - w.x, y = a[1] - w.y, z = a[2] - w.z;
  return x * x + y * y + z * z;
}

/// Returns the largest of eight numbers.
inline float largest_of(const Float8& x) {
  const Float8 four = larger(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
  const Float8 two = larger(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 2, 3, 0, 1));
  return two[0] > two[1] ? two[0] : two[1];
}

}  // namespace pharos::parallax_aware_mixtures

#pragma once

#include <cstddef>

#include <pharos/core/simd.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/toolkit/lobe_products.h>

/// Eight lobes side by side.
namespace pharos::parallax_aware_mixtures {

inline constexpr std::size_t kLanes = 8;

inline Float8 squared_distance(const Float8 (&a)[3], Vec3 w) {
  return pharos::squared_distance(Lanes3<Float8>{a[0], a[1], a[2]}, w);
}

/// Returns the largest of eight numbers.
inline float largest_of(const Float8& x) {
  const Float8 four = larger(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
  const Float8 two = larger(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 2, 3, 0, 1));
  return two[0] > two[1] ? two[0] : two[1];
}

}  // namespace pharos::parallax_aware_mixtures

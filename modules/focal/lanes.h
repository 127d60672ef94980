#pragma once

#include <array>
#include <bit>
#include <cstdint>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace pharos::focal {

/// Eight numbers, one for each child of a node, computed with side by side: one register with
/// AVX-512, two with AVX2. Passed by reference only, as calling conventions differ.
using Lanes = double __attribute__((vector_size(64)));
/// Three coordinates and one number more.
using Quad = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(64)));

using FloatLanes = float __attribute__((vector_size(32)));
using WordLanes = std::int32_t __attribute__((vector_size(32)));

/// The lower corner of each child in units of its edge, and a one.
inline constexpr Quad kCorner[8] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1},
                                    {0, 0, 1, 1}, {1, 0, 1, 1}, {0, 1, 1, 1}, {1, 1, 1, 1}};

/// 1 in the lanes of children in the upper half along an axis, 0 in the others; and the opposite.
inline constexpr Lanes kUpper[3] = {
    {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};
inline constexpr Lanes kLower[3] = {
    {1, 0, 1, 0, 1, 0, 1, 0}, {1, 1, 0, 0, 1, 1, 0, 0}, {1, 1, 1, 1, 0, 0, 0, 0}};

/// The lanes of a mask as bits.
inline unsigned to_bits(const LaneMask& mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(std::bit_cast<__m512i>(mask));
#elif defined(__AVX__)
  const auto halves = std::bit_cast<std::array<__m256d, 2>>(mask);
  return static_cast<unsigned>(_mm256_movemask_pd(halves[0]) | _mm256_movemask_pd(halves[1]) << 4);
#else
  unsigned bits = 0;
  for (int c = 0; c < 8; ++c) bits |= static_cast<unsigned>(mask[c] & 1) << c;
  return bits;
#endif
}

}  // namespace pharos::focal

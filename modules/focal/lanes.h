#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace pharos::focal {

/// Eight numbers, one for each child of a node, computed with side by side: one register with
/// AVX-512, two with AVX2. Passed by reference only, as calling conventions differ.
using Lanes = double __attribute__((vector_size(64)));
using LaneMask = std::int64_t __attribute__((vector_size(64)));
using FloatLanes = float __attribute__((vector_size(32)));
using WordLanes = std::int32_t __attribute__((vector_size(32)));

/// 1 in the lanes of the children that a line enters last along an axis, 0 in the others: those of
/// the upper half, or for lines that go downwards those of the lower half.
inline constexpr Lanes kBeyond[3][2] = {{{0, 1, 0, 1, 0, 1, 0, 1}, {1, 0, 1, 0, 1, 0, 1, 0}},
                                        {{0, 0, 1, 1, 0, 0, 1, 1}, {1, 1, 0, 0, 1, 1, 0, 0}},
                                        {{0, 0, 0, 0, 1, 1, 1, 1}, {1, 1, 1, 1, 0, 0, 0, 0}}};

#if defined(__AVX512F__)
/// Masked forms with all lanes: GCC 12 warns of the plain ones (its bug 105593).
inline constexpr __mmask8 kAll = 0xff;
#endif

/// To an address that is a multiple of 64.
inline void store(const Lanes& lanes, double* to) {
  std::memcpy(std::assume_aligned<64>(to), &lanes, sizeof lanes);
}

/// The larger of both numbers in each lane, to `a`.
inline void keep_larger(Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  a = std::bit_cast<Lanes>(
      _mm512_maskz_max_pd(kAll, std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b)));
#else
  a = a > b ? a : b;
#endif
}

/// The smaller of both numbers in each lane, to `a`.
inline void keep_smaller(Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  a = std::bit_cast<Lanes>(
      _mm512_maskz_min_pd(kAll, std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b)));
#else
  a = a < b ? a : b;
#endif
}

inline double sum_of(const Lanes& a) {
  return ((a[0] + a[4]) + (a[1] + a[5])) + ((a[2] + a[6]) + (a[3] + a[7]));
}

inline void widen(const FloatLanes& floats, Lanes& to) {
#if defined(__AVX512F__)
  to = std::bit_cast<Lanes>(_mm512_maskz_cvtps_pd(kAll, std::bit_cast<__m256>(floats)));
#else
  to = __builtin_convertvector(floats, Lanes);
#endif
}

/// The lanes where a < b, as bits.
inline unsigned less_bits(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b), _CMP_LT_OQ);
#elif defined(__AVX__)
  const LaneMask mask = a < b;
  __m256d halves[2];
  std::memcpy(halves, &mask, sizeof mask);
  return static_cast<unsigned>(_mm256_movemask_pd(halves[0]) | _mm256_movemask_pd(halves[1]) << 4);
#else
  const LaneMask mask = a < b;
  unsigned bits = 0;
  for (int c = 0; c < 8; ++c) bits |= static_cast<unsigned>(mask[c] & 1) << c;
  return bits;
#endif
}

/// The lanes whose sign bit is set, as bits.
inline unsigned sign_bits(const WordLanes& words) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(words)));
#else
  unsigned bits = 0;
  for (int c = 0; c < 8; ++c) bits |= static_cast<unsigned>(words[c] < 0) << c;
  return bits;
#endif
}

}  // namespace pharos::focal

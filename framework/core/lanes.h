#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#if defined(__AVX__)
#include <immintrin.h>
#endif

/// Numbers that are computed with side by side: vectors of the compiler, whose operators work
/// element by element, and the functions that these do not have. Comparisons give masks; `mask ? a
/// : b` chooses element by element.
namespace pharos {

using Float8 = float __attribute__((vector_size(32)));
using Double4 = double __attribute__((vector_size(32)));
using Mask8 = std::int32_t __attribute__((vector_size(32)));
using Mask4 = std::int64_t __attribute__((vector_size(32)));

/// The same number at all places. (A difference, as x + 0 may not be left out.)
inline Float8 all8(float x) {
  return x - Float8{};
}
inline Double4 all4(double x) {
  return x - Double4{};
}

/// Neighbours in memory; addresses need no alignment.
inline Float8 load8(const float* from) {
  Float8 x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
inline Double4 load4(const double* from) {
  Double4 x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

/// Numbers of double precision rounded to single.
inline Float8 rounded(const Double4& low, const Double4& high) {
#if defined(__AVX__)
  return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
#else
  Float8 x;
  for (int i = 0; i < 4; ++i) {
    x[i] = static_cast<float>(low[i]);
    x[i + 4] = static_cast<float>(high[i]);
  }
  return x;
#endif
}

inline Float8 sqrt(const Float8& x) {
#if defined(__AVX__)
  return _mm256_sqrt_ps(x);
#else
  Float8 r;
  for (int i = 0; i < 8; ++i) r[i] = std::sqrt(x[i]);
  return r;
#endif
}
inline Double4 sqrt(const Double4& x) {
#if defined(__AVX__)
  return _mm256_sqrt_pd(x);
#else
  Double4 r;
  for (int i = 0; i < 4; ++i) r[i] = std::sqrt(x[i]);
  return r;
#endif
}

/// The larger and the smaller of two numbers.
template <class Lanes>
Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}
template <class Lanes>
Lanes smaller(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}

/// Whether the mask is set anywhere.
inline bool any(const Mask8& mask) {
#if defined(__AVX__)
  return _mm256_movemask_ps(std::bit_cast<__m256>(mask)) != 0;
#else
  std::int32_t bits = 0;
  for (int i = 0; i < 8; ++i) bits |= mask[i];
  return bits != 0;
#endif
}

/// Sums of all, always added in the same order.
inline float sum(const Float8& x) {
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}
inline double sum(const Double4& x) {
  return (x[0] + x[2]) + (x[1] + x[3]);
}

/// e^x for x below 88, relative error below 2e-7; 0 below -87.
inline Float8 exp(const Float8& x) {
  constexpr float kLog2E = 1.44269504f;
  // ln 2 in two parts: multiples of the first are exact.
  constexpr float kLn2High = 0.693359375f, kLn2Low = -2.12194440e-4f;
  constexpr float kRound = 0x1.8p23f;  // added, it leaves no room for fractions
  constexpr float kLeast = -87;
  const Float8 bounded = larger(x, all8(kLeast));
  const Float8 shifted = bounded * kLog2E + kRound;
  const Float8 n = shifted - kRound;
  const Float8 r = (bounded - n * kLn2High) - n * kLn2Low;
  Float8 p = all8(1.0f / 5040);
  for (const float c : {1.0f / 720, 1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f, 1.0f}) {
    p = p * r + c;
  }
  const Mask8 exponent = (std::bit_cast<Mask8>(shifted) + 127) << 23;
  return x < kLeast ? Float8{} : p * std::bit_cast<Float8>(exponent);
}

/// e^x for x below 709, relative error below 1e-15; 0 below -708.
inline Double4 exp(const Double4& x) {
  constexpr double kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;
  constexpr double kRound = 0x1.8p52;
  constexpr double kLeast = -708;
  const Double4 bounded = larger(x, all4(kLeast));
  const Double4 shifted = bounded * kLog2E + kRound;
  const Double4 n = shifted - kRound;
  const Double4 r = (bounded - n * kLn2High) - n * kLn2Low;
  Double4 p = all4(1.0 / 6227020800);
  for (const double c : {1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320,
                         1.0 / 5040, 1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5, 1.0, 1.0}) {
    p = p * r + c;
  }
  const Mask4 exponent = (std::bit_cast<Mask4>(shifted) + 1023) << 52;
  return x < kLeast ? Double4{} : p * std::bit_cast<Double4>(exponent);
}

}  // namespace pharos

#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#if defined(__AVX__)
#include <immintrin.h>
#endif

/// SIMD vectors: vector types of the compiler, whose operators work element by element, and
/// functions that the compiler does not provide. Comparisons return masks; `mask ? a : b` selects
/// element by element.
namespace pharos {

using Float8 = float __attribute__((vector_size(32)));
using Double4 = double __attribute__((vector_size(32)));
using Mask8 = std::int32_t __attribute__((vector_size(32)));

/// Four floats, an intermediate step on the way to and from memory.
using Float4 = float __attribute__((vector_size(16)));

/// Returns a vector with `x` in all elements. (The code subtracts zero because the compiler may
/// omit x - 0, but not x + 0.)
inline Float8 all8(float x) {
  return x - Float8{};
}

/// The result of transposing four vectors: row i holds element i of each vector.
struct Transposed4 {
  Float4 rows[4];
};
inline Transposed4 transposed(const Float4& a, const Float4& b, const Float4& c, const Float4& d) {
  const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {{__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
           __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
           __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
           __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)}};
}

/// Converts the numbers to double precision.
inline Double4 widened(const Float4& x) {
#if defined(__AVX__)
  return _mm256_cvtps_pd(x);
#else
  return __builtin_convertvector(x, Double4);
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

/// Eight doubles, in one register if registers are wide enough. Otherwise they are in two, and
/// operations on the two can run at the same time.
struct Double8 {
#if defined(__AVX512F__)
  using Part = double __attribute__((vector_size(64)));
#else
  using Part = Double4;
#endif
  static constexpr int kParts = sizeof(Part) == sizeof(Double4) ? 2 : 1;
  Part parts[kParts];

  /// Makes eight numbers. `compute(k)` returns part k.
  template <class Compute>
  static Double8 each(Compute&& compute) {
    Double8 result;
    for (int k = 0; k < kParts; ++k) result.parts[k] = compute(k);
    return result;
  }
  friend Double8 operator+(const Double8& a, const Double8& b) {
    return each([&](int k) { return a.parts[k] + b.parts[k]; });
  }
  friend Double8 operator-(const Double8& a, const Double8& b) {
    return each([&](int k) { return a.parts[k] - b.parts[k]; });
  }
  friend Double8 operator*(const Double8& a, const Double8& b) {
    return each([&](int k) { return a.parts[k] * b.parts[k]; });
  }
  friend Double8 operator/(const Double8& a, const Double8& b) {
    return each([&](int k) { return a.parts[k] / b.parts[k]; });
  }
  friend Double8 operator-(const Double8& a) {
    return each([&](int k) { return -a.parts[k]; });
  }
  friend Double8 operator+(const Double8& a, double b) {
    return each([&](int k) { return a.parts[k] + b; });
  }
  friend Double8 operator-(const Double8& a, double b) {
    return each([&](int k) { return a.parts[k] - b; });
  }
  friend Double8 operator-(double a, const Double8& b) {
    return each([&](int k) { return a - b.parts[k]; });
  }
  friend Double8 operator*(double a, const Double8& b) {
    return each([&](int k) { return a * b.parts[k]; });
  }
  Double8& operator+=(const Double8& other) {
    return *this = *this + other;
  }

  double operator[](int i) const {
    return parts[i / (8 / kParts)][i % (8 / kParts)];
  }
};
inline Double8 all_doubles8(double x) {
  return Double8::each([&](int) { return x - Double8::Part{}; });
}

/// Loads eight neighbors in memory. The address needs no alignment.
inline Double8 load8(const double* from) {
  Double8 x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

#if defined(__AVX512F__)
/// The mask of all eight lanes. GCC 12 warns of the intrinsics without a mask, because their
/// definitions use an uninitialized value (GCC bug 105593), and __builtin_convertvector() is
/// slower.
inline constexpr __mmask8 kAllLanes = 0xff;
#endif

inline Double8 widened(const Float8& x) {
#if defined(__AVX512F__)
  return {{_mm512_maskz_cvtps_pd(kAllLanes, x)}};
#else
  return {{widened(__builtin_shufflevector(x, x, 0, 1, 2, 3)),
           widened(__builtin_shufflevector(x, x, 4, 5, 6, 7))}};
#endif
}

/// Rounds numbers of double precision to single precision.
inline Float4 rounded(const Double4& x) {
#if defined(__AVX__)
  return _mm256_cvtpd_ps(x);
#else
  return __builtin_convertvector(x, Float4);
#endif
}
inline Float8 rounded(const Double8& x) {
#if defined(__AVX512F__)
  return _mm512_maskz_cvtpd_ps(kAllLanes, x.parts[0]);
#else
  const Float4 low = rounded(x.parts[0]), high = rounded(x.parts[1]);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

/// Returns the larger of two numbers, element by element.
inline Float8 larger(const Float8& a, const Float8& b) {
#if defined(__AVX__)
  return _mm256_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}
inline Double8 larger(const Double8& a, const Double8& b) {
  return Double8::each([&](int k) -> Double8::Part {
#if defined(__AVX512F__)
    return _mm512_maskz_max_pd(kAllLanes, a.parts[k], b.parts[k]);
#elif defined(__AVX__)
    return _mm256_max_pd(a.parts[k], b.parts[k]);
#else
    return a.parts[k] > b.parts[k] ? a.parts[k] : b.parts[k];
#endif
  });
}
inline Float8 absolute(const Float8& x) {
  return larger(x, -x);
}

/// Returns a bit mask of the elements that are set.
inline unsigned bits_of(const Mask8& mask) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(mask)));
#else
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= (mask[i] != 0 ? 1u : 0u) << i;
  return bits;
#endif
}
/// Returns whether any element of the mask is set.
inline bool any(const Mask8& mask) {
  return bits_of(mask) != 0;
}

/// Returns whether all elements are below a limit.
inline bool all_below(const Double8& x, double limit) {
  bool all = true;
  for (const Double8::Part& part : x.parts) {
#if defined(__AVX512F__)
    all &= _mm512_cmp_pd_mask(part, Double8::Part{} + limit, _CMP_LT_OQ) == kAllLanes;
#elif defined(__AVX__)
    all &= _mm256_movemask_pd(_mm256_cmp_pd(part, Double8::Part{} + limit, _CMP_LT_OQ)) == 0xf;
#else
    for (int i = 0; i < 4; ++i) all &= part[i] < limit;
#endif
  }
  return all;
}

/// Returns the sum of all elements. The order of the additions is fixed.
inline float sum(const Float8& x) {
  const Float4 four =
      __builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7);
  const Float4 two = four + __builtin_shufflevector(four, four, 2, 3, 0, 1);
  return two[0] + two[1];
}
inline double sum(const Double8& x) {
  const double low = (x[0] + x[2]) + (x[1] + x[3]), high = (x[4] + x[6]) + (x[5] + x[7]);
  return low + high;
}

/// Returns 2^x for x below 128, with a relative error below 3e-7. Returns 0 for x below -126, and
/// 2^-126 for NaN.
inline Float8 exp2(const Float8& x) {
  constexpr float kRound = 0x1.8p23f;  // adding it rounds to an integer
  constexpr float kLeast = -126;
  const Float8 bounded = larger(x, all8(kLeast));
  const Float8 shifted = bounded + kRound;
  const Float8 r = bounded - (shifted - kRound);
  // Taylor polynomial of degree 6, arranged so that few steps depend on each other.
  const Float8 r2 = r * r;
  const Float8 high = (9.61812911e-3f + r * 1.33335581e-3f) + r2 * 1.54035304e-4f;
  const Float8 p = (1 + r * 0.693147181f) + r2 * ((0.240226507f + r * 5.55041087e-2f) + r2 * high);
  const Mask8 exponent = (std::bit_cast<Mask8>(shifted) + 127) << 23;
  return x < kLeast ? Float8{} : p * std::bit_cast<Float8>(exponent);
}

inline constexpr float kLog2E = 1.44269504f;

/// Returns e^x for x below 88, and 0 for x below -87. The relative error is the error of exp2()
/// plus 1e-7 times |x|.
inline Float8 exp(const Float8& x) {
  return exp2(x * kLog2E);
}

/// Returns e^x for x below 709, with a relative error below 1e-15. Returns 0 for x below -708.
inline Double8 exp(const Double8& x) {
  constexpr double kOverLn2 = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;
  constexpr double kRound = 0x1.8p52;
  constexpr double kLeast = -708;
  using Exponents = std::int64_t __attribute__((vector_size(sizeof(Double8::Part))));
  const Double8 bounded = larger(x, all_doubles8(kLeast));
  return Double8::each([&](int k) -> Double8::Part {
    const Double8::Part shifted = bounded.parts[k] * kOverLn2 + kRound;
    const Double8::Part n = shifted - kRound;
    const Double8::Part r = (bounded.parts[k] - n * kLn2High) - n * kLn2Low;
    Double8::Part p = r * (1.0 / 6227020800) + 1.0 / 479001600;
    for (const double c : {1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040,
                           1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5, 1.0, 1.0}) {
      p = p * r + c;
    }
    const Exponents exponent = (std::bit_cast<Exponents>(shifted) + 1023) << 52;
    return x.parts[k] < kLeast ? Double8::Part{} : p * std::bit_cast<Double8::Part>(exponent);
  });
}

/// Returns the natural logarithm of normal numbers above 0. Its error is below 1e-15 times the
/// larger of 1 and the result.
inline Double8 log(const Double8& x) {
  constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;
  using Bits = std::uint64_t __attribute__((vector_size(sizeof(Double8::Part))));
  constexpr auto kOne = std::bit_cast<std::uint64_t>(1.0);
  constexpr auto kSqrtHalf = std::bit_cast<std::uint64_t>(0.70710678118654752);
  constexpr double kInteger = 0x1p52;  // its mantissa is an integer with a place value of 1
  return Double8::each([&](int k) -> Double8::Part {
    // x = 2^n m, with m between the square roots of 1/2 and 2.
    const Bits bits = std::bit_cast<Bits>(x.parts[k]);
    const Bits biased = (bits - kSqrtHalf + kOne) >> 52;
    const auto m = std::bit_cast<Double8::Part>(bits - (biased << 52) + kOne);
    const Double8::Part n =
        std::bit_cast<Double8::Part>(biased | std::bit_cast<std::uint64_t>(kInteger)) -
        (kInteger + 1023);
    // log m = 2 artanh s, by the Taylor series of artanh.
    const Double8::Part s = (m - 1) / (m + 1), s2 = s * s;
    Double8::Part p = s2 * (2.0 / 21) + 2.0 / 19;
    for (const double c :
         {2.0 / 17, 2.0 / 15, 2.0 / 13, 2.0 / 11, 2.0 / 9, 2.0 / 7, 2.0 / 5, 2.0 / 3, 2.0}) {
      p = p * s2 + c;
    }
    return n * kLn2High + (n * kLn2Low + s * p);
  });
}

}  // namespace pharos

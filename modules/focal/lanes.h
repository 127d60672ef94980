#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace pharos::focal {

/// How many doubles a register of the processor holds.
#if defined(__AVX512F__)
inline constexpr int kRegisterWidth = 8;
#elif defined(__AVX__)
inline constexpr int kRegisterWidth = 4;
#else
inline constexpr int kRegisterWidth = 2;
#endif
using Register = double __attribute__((vector_size(8 * kRegisterWidth)));

/// Eight numbers, one for each child of a node, computed with side by side in registers: one with
/// AVX-512, two with AVX2. (Vectors that are wider than registers are moved about in memory.)
struct alignas(64) Lanes {
  static constexpr int kRegisters = 8 / kRegisterWidth;
  Register registers[kRegisters];

  /// (A difference, as the compiler must not leave a sum with +0 out.)
  static Lanes all(double value) {
    return each([&](int) { return value - Register{}; });
  }
  /// From and to an address that is a multiple of 64.
  static Lanes load(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes, __builtin_assume_aligned(from, 64), sizeof lanes);
    return lanes;
  }
  void store(double* to) const {
    std::memcpy(__builtin_assume_aligned(to, 64), this, sizeof *this);
  }

  double operator[](unsigned i) const { return registers[i / kRegisterWidth][i % kRegisterWidth]; }
  double sum() const {
    const Lanes& a = *this;
    return ((a[0] + a[4]) + (a[1] + a[5])) + ((a[2] + a[6]) + (a[3] + a[7]));
  }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return each([&](int k) { return a.registers[k] + b.registers[k]; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return each([&](int k) { return a.registers[k] - b.registers[k]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return each([&](int k) { return a.registers[k] * b.registers[k]; });
  }

  /// Makes lanes of `compute(k)`, the register k.
  template <class Compute>
  static Lanes each(Compute&& compute) {
    Lanes lanes;
    for (int k = 0; k < kRegisters; ++k) lanes.registers[k] = compute(k);
    return lanes;
  }
};

/// Eight words of 32 bits.
using Words = std::array<std::uint32_t, 8>;

/// 1 in the lanes of the children that a line enters last along an axis, 0 in the others: those of
/// the upper half, or for lines that go downwards those of the lower half.
alignas(64) inline constexpr double kBeyond[3][2][8] = {
    {{0, 1, 0, 1, 0, 1, 0, 1}, {1, 0, 1, 0, 1, 0, 1, 0}},
    {{0, 0, 1, 1, 0, 0, 1, 1}, {1, 1, 0, 0, 1, 1, 0, 0}},
    {{0, 0, 0, 0, 1, 1, 1, 1}, {1, 1, 1, 1, 0, 0, 0, 0}}};

// GCC 12 warns of the plain forms of AVX-512 (its bug 105593): masks name all lanes.

inline Lanes larger(const Lanes& a, const Lanes& b) {
  return Lanes::each([&](int k) -> Register {
    const Register &x = a.registers[k], &y = b.registers[k];
#if defined(__AVX512F__)
    return _mm512_maskz_max_pd(0xff, x, y);
#elif defined(__AVX__)
    return _mm256_max_pd(x, y);
#else
    return x > y ? x : y;
#endif
  });
}

inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return Lanes::each([&](int k) -> Register {
    const Register &x = a.registers[k], &y = b.registers[k];
#if defined(__AVX512F__)
    return _mm512_maskz_min_pd(0xff, x, y);
#elif defined(__AVX__)
    return _mm256_min_pd(x, y);
#else
    return x < y ? x : y;
#endif
  });
}

/// The lanes where a < b, as bits.
inline unsigned less_bits(const Lanes& a, const Lanes& b) {
  unsigned bits = 0;
  for (int k = 0; k < Lanes::kRegisters; ++k) {
    const Register &x = a.registers[k], &y = b.registers[k];
#if defined(__AVX512F__)
    const unsigned part = _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ);
#elif defined(__AVX__)
    const auto part = static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(x, y, _CMP_LT_OQ)));
#else
    const unsigned part = (x[0] < y[0] ? 1u : 0u) | (x[1] < y[1] ? 2u : 0u);
#endif
    bits |= part << (k * kRegisterWidth);
  }
  return bits;
}

/// The words whose highest bit is set, as bits.
inline unsigned high_bits(const Words& words) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(words)));
#else
  unsigned bits = 0;
  for (unsigned c = 0; c < 8; ++c) bits |= words[c] >> 31 << c;
  return bits;
#endif
}

/// The words as floats; 0 for those whose highest bit is set.
inline Lanes positive_floats(const Words& words) {
  Words masked;
  for (unsigned c = 0; c < 8; ++c) {
    masked[c] = words[c] & ~static_cast<std::uint32_t>(static_cast<std::int32_t>(words[c]) >> 31);
  }
#if defined(__AVX512F__)
  return {_mm512_maskz_cvtps_pd(0xff, std::bit_cast<__m256>(masked))};
#elif defined(__AVX__)
  const auto halves = std::bit_cast<__m256>(masked);
  return {_mm256_cvtps_pd(_mm256_castps256_ps128(halves)),
          _mm256_cvtps_pd(_mm256_extractf128_ps(halves, 1))};
#else
  return Lanes::each([&](int k) {
    return Register{std::bit_cast<float>(masked[2 * k]), std::bit_cast<float>(masked[2 * k + 1])};
  });
#endif
}

}  // namespace pharos::focal

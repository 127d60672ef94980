#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace pharos::focal {

/// The number of doubles per register. Registers of eight doubles were slower, because half of the
/// work for a node needs only four numbers.
#if defined(__AVX__)
inline constexpr int kRegisterWidth = 4;
#else
inline constexpr int kRegisterWidth = 2;
#endif
using Register = double __attribute__((vector_size(8 * kRegisterWidth)));

/// Four numbers that are processed side by side in registers.
struct alignas(32) Quad {
  static constexpr int kRegisters = 4 / kRegisterWidth;
  Register registers[kRegisters];

  /// Copies a number to all places. The code uses a difference, because the compiler must not omit
  /// a sum with +0.
  static Quad all(double value) {
    return each([&](int) { return value - Register{}; });
  }
  /// Loads the number at an address directly into all places. With all(), compilers multiply first
  /// and then broadcast the product.
  static Quad broadcast(const double* from) {
#if defined(__AVX__)
    return {{_mm256_broadcast_sd(from)}};
#else
    return all(*from);
#endif
  }
  /// Loads numbers from an address that is a multiple of 32; store() requires the same alignment.
  static Quad load(const double* from) {
    Quad quad;
    std::memcpy(&quad, __builtin_assume_aligned(from, 32), sizeof quad);
    return quad;
  }
  void store(double* to) const {
    std::memcpy(__builtin_assume_aligned(to, 32), this, sizeof *this);
  }

  double operator[](unsigned i) const {
    return registers[i / kRegisterWidth][i % kRegisterWidth];
  }
  double sum() const {
    return ((*this)[0] + (*this)[1]) + ((*this)[2] + (*this)[3]);
  }

  friend Quad operator+(const Quad& a, const Quad& b) {
    return each([&](int k) { return a.registers[k] + b.registers[k]; });
  }
  friend Quad operator-(const Quad& a, const Quad& b) {
    return each([&](int k) { return a.registers[k] - b.registers[k]; });
  }
  friend Quad operator*(const Quad& a, const Quad& b) {
    return each([&](int k) { return a.registers[k] * b.registers[k]; });
  }

  /// Makes four numbers. `compute(k)` returns register k.
  template <class Compute>
  static Quad each(Compute&& compute) {
    Quad quad;
    for (int k = 0; k < kRegisters; ++k) quad.registers[k] = compute(k);
    return quad;
  }
};

/// Eight numbers, one for each child of a node: first the children at the lower end of z, then the
/// children at its upper end.
struct Lanes {
  Quad lower, upper;

  double operator[](unsigned c) const { return c < 4 ? lower[c] : upper[c - 4]; }

  static Lanes all(double value) { return {Quad::all(value), Quad::all(value)}; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return {a.lower + b.lower, a.upper + b.upper};
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return {a.lower - b.lower, a.upper - b.upper};
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.lower * b.lower, a.upper * b.upper};
  }
};

/// Eight words of 32 bits. An array would pass through memory on its way to a register.
#if defined(__AVX__)
using Words = std::uint32_t __attribute__((vector_size(32)));
#else
using Words = std::array<std::uint32_t, 8>;
#endif

inline Quad larger(const Quad& a, const Quad& b) {
  return Quad::each([&](int k) -> Register {
    const Register &x = a.registers[k], &y = b.registers[k];
#if defined(__AVX__)
    return _mm256_max_pd(x, y);
#else
    return x > y ? x : y;
#endif
  });
}

inline Quad smaller(const Quad& a, const Quad& b) {
  return Quad::each([&](int k) -> Register {
    const Register &x = a.registers[k], &y = b.registers[k];
#if defined(__AVX__)
    return _mm256_min_pd(x, y);
#else
    return x < y ? x : y;
#endif
  });
}

inline Lanes larger(const Lanes& a, const Lanes& b) {
  return {larger(a.lower, b.lower), larger(a.upper, b.upper)};
}
inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return {smaller(a.lower, b.lower), smaller(a.upper, b.upper)};
}

/// Adds number i to `sums[i ^ mirror]`.
inline void add_mirrored(const Lanes& numbers, unsigned mirror, double* sums) {
  for (unsigned i = 0; i < 8; ++i) sums[i ^ mirror] += numbers[i];
}

/// Returns 2 a + b as one fused operation. Compilers would otherwise turn 2 a into a + a and then
/// add b.
inline Quad twice_plus(const Quad& a, const Quad& b) {
  return Quad::each([&](int k) -> Register {
    const Register &x = a.registers[k], &y = b.registers[k];
#if defined(__AVX__) && defined(__FMA__)
    return _mm256_fmadd_pd(x, _mm256_set1_pd(2), y);
#else
    return x + x + y;
#endif
  });
}

/// Returns a bit mask of the negative numbers.
inline std::uint64_t negative_bits(const Quad& a) {
  std::uint64_t bits = 0;
  for (int k = 0; k < Quad::kRegisters; ++k) {
    const Register& x = a.registers[k];
#if defined(__AVX__)
    const auto part = static_cast<unsigned>(_mm256_movemask_pd(x));
#else
    const unsigned part = (x[0] < 0 ? 1u : 0u) | (x[1] < 0 ? 2u : 0u);
#endif
    bits |= std::uint64_t{part} << (k * kRegisterWidth);
  }
  return bits;
}

inline std::uint64_t negative_bits(const Lanes& a) {
  return negative_bits(a.lower) | negative_bits(a.upper) << 4;
}

/// Returns the words in another order: word `order[i]` at place i.
inline Words permuted(const Words& words, const Words& order) {
#if defined(__AVX2__)
  return std::bit_cast<Words>(
      _mm256_permutevar8x32_epi32(std::bit_cast<__m256i>(words), std::bit_cast<__m256i>(order)));
#else
  Words result{};
  for (unsigned i = 0; i < 8; ++i) result[i] = words[order[i]];
  return result;
#endif
}

/// Returns a bit mask of the words whose highest bit is set.
inline std::uint64_t high_bits(const Words& words) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(words)));
#else
  unsigned bits = 0;
  for (unsigned c = 0; c < 8; ++c) bits |= words[c] >> 31 << c;
  return bits;
#endif
}

/// Returns the words as floats, and 0 for words whose highest bit is set.
inline Lanes positive_floats(const Words& words) {
#if defined(__AVX__)
  // Words with the highest bit set are negative or NaN as floats. The maximum of such a float and 0
  // is 0.
  const __m256 floats = _mm256_max_ps(std::bit_cast<__m256>(words), _mm256_setzero_ps());
  return {{_mm256_cvtps_pd(_mm256_castps256_ps128(floats))},
          {_mm256_cvtps_pd(_mm256_extractf128_ps(floats, 1))}};
#else
  const auto half = [&](unsigned first) {
    return Quad::each([&](int k) {
      const auto positive = [&](unsigned c) -> double {
        return (words[c] >> 31) != 0 ? 0.0f : std::bit_cast<float>(words[c]);
      };
      const unsigned c = first + 2 * static_cast<unsigned>(k);
      return Register{positive(c), positive(c + 1)};
    });
  };
  return {half(0), half(4)};
#endif
}

/// Returns 1 for words whose highest bit is not set, and 0 for the other words.
inline Lanes ones_where_positive(const Words& words) {
  constexpr std::uint32_t kSign = 0x80000000u, kOne = std::bit_cast<std::uint32_t>(1.0f);
#if defined(__AVX__)
  return positive_floats((words & kSign) | kOne);
#else
  Words ones;
  for (unsigned i = 0; i < 8; ++i) ones[i] = (words[i] & kSign) | kOne;
  return positive_floats(ones);
#endif
}

}  // namespace pharos::focal

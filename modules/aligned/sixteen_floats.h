#pragma once

#include <cstddef>
#include <cstring>

namespace pharos::aligned {

/// Sixteen floats that are processed side by side, in as many registers as necessary. Results have
/// the same bits for any width of the registers.
struct SixteenFloats {
#if defined(__AVX__)
  static constexpr std::size_t kRegisterWidth = 8;
#else
  static constexpr std::size_t kRegisterWidth = 4;
#endif
  static constexpr std::size_t kCount = 16, kRegisters = kCount / kRegisterWidth;
  // Compilers keep vectors in memory if they are wider than the processor's registers.
  using Register = float __attribute__((vector_size(4 * kRegisterWidth)));

  Register registers[kRegisters] = {};

  float operator[](std::size_t i) const {
    return registers[i / kRegisterWidth][i % kRegisterWidth];
  }

  /// Returns the sum of all floats. Halves are added until one number is left.
  float sum() const {
    float sums[kCount / 2];
    for (std::size_t r = 0; r < kRegisters / 2; ++r) {
      const Register both = registers[r] + registers[r + kRegisters / 2];
      std::memcpy(sums + r * kRegisterWidth, &both, sizeof both);
    }
    for (std::size_t i = 0; i < 4; ++i) sums[i] += sums[i + 4];
    return (sums[0] + sums[2]) + (sums[1] + sums[3]);
  }

  SixteenFloats& operator+=(const SixteenFloats& other) {
    for (std::size_t r = 0; r < kRegisters; ++r) registers[r] += other.registers[r];
    return *this;
  }
  friend SixteenFloats operator+(SixteenFloats a, const SixteenFloats& b) {
    return a += b;
  }
  friend SixteenFloats operator-(const SixteenFloats& a, const SixteenFloats& b) {
    SixteenFloats difference;
    for (std::size_t r = 0; r < kRegisters; ++r) {
      difference.registers[r] = a.registers[r] - b.registers[r];
    }
    return difference;
  }
  friend SixteenFloats operator*(const SixteenFloats& a, const SixteenFloats& b) {
    SixteenFloats product;
    for (std::size_t r = 0; r < kRegisters; ++r) {
      product.registers[r] = a.registers[r] * b.registers[r];
    }
    return product;
  }
  friend SixteenFloats operator*(float factor, const SixteenFloats& a) {
    SixteenFloats product;
    for (std::size_t r = 0; r < kRegisters; ++r) product.registers[r] = factor * a.registers[r];
    return product;
  }
};

}  // namespace pharos::aligned

#pragma once

#include <bit>
#include <cstdint>

#include <pharos/core/vec.h>

/// Numbers in [0, 1) as whole steps of 2^-24, which can be moved without rounding.
namespace pharos {

/// Returns the step that contains a number of [0, 1). The numbers of most samplers are whole steps.
constexpr std::int32_t steps_of(float u) {
  return static_cast<std::int32_t>(u * 0x1p24f);
}

/// Returns the number at `steps` steps, modulo one.
constexpr float number_of(std::int32_t steps) {
  return static_cast<float>(steps & 0xffffff) * 0x1p-24f;
}

/// Moves a point on the torus by `offset`, whose halves are 32-bit fractions. The lower half moves
/// x. Both coordinates are computed side by side.
inline Vec2 moved(Vec2 u, std::uint64_t offset) {
  using Floats = float __attribute__((vector_size(8)));
  using Steps = std::int32_t __attribute__((vector_size(8)));
  using Words = std::uint32_t __attribute__((vector_size(8)));
  const auto from = __builtin_convertvector(std::bit_cast<Floats>(u) * 0x1p24f, Steps);
  const auto by = std::bit_cast<Steps>(std::bit_cast<Words>(offset) >> 8);
  return std::bit_cast<Vec2>(__builtin_convertvector((from + by) & 0xffffff, Floats) * 0x1p-24f);
}

}  // namespace pharos

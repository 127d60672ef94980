#pragma once

#include <cstdint>

/// Numbers in [0, 1) as whole steps of 2^-24, in which they can be moved without rounding.
namespace pharos {

/// The step in which a number of [0, 1) lies; most samplers' numbers are whole steps.
constexpr std::int32_t steps_of(float u) {
  return static_cast<std::int32_t>(u * 0x1p24f);
}

/// The number that so many steps are, modulo one.
constexpr float number_of(std::int32_t steps) {
  return static_cast<float>(steps & 0xffffff) * 0x1p-24f;
}

}  // namespace pharos

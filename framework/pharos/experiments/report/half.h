#pragma once

#include <cstdint>

namespace pharos {

inline constexpr float kLargestHalf = 65504;

/// The bits of the nearest IEEE 754 binary16 number, ties to even. Beyond 65520 that is infinity,
/// below 2^-25 zero; NaN stays NaN (one quiet pattern), signs stay.
std::uint16_t half_from_float(float value);

/// The number that binary16 bits stand for; exact.
float float_from_half(std::uint16_t bits);

}  // namespace pharos

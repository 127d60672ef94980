#pragma once

#include <cstdint>

namespace pharos {

inline constexpr float kLargestHalf = 65504;

/// Returns the bits of the nearest IEEE 754 binary16 number, ties to even. Values beyond 65520
/// become infinity and values below 2^-25 become zero. NaN stays NaN (one quiet pattern), and signs
/// are kept.
std::uint16_t half_from_float(float value);

/// Returns the number that the bits of a binary16 represent; exact.
float float_from_half(std::uint16_t bits);

}  // namespace pharos

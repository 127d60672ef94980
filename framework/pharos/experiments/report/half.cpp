#include <bit>
#include <cmath>
#include <limits>

#include <pharos/experiments/report/half.h>

namespace pharos {

std::uint16_t half_from_float(float value) {
  constexpr std::uint32_t kInfinity = 0x7f800000, kBeyondHalf = 0x477ff000;  // 65520
  constexpr std::uint32_t kSmallestNormal = 0x38800000;                      // 2^-14
  constexpr std::uint32_t kExponentShift = (127 - 15) << 23;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000);
  std::uint32_t magnitude = bits & 0x7fffffff;
  if (magnitude > kInfinity) return sign | 0x7e00;
  if (magnitude >= kBeyondHalf) return sign | 0x7c00;
  if (magnitude < kSmallestNormal) {
    // Counts multiples of 2^-24. 1024 of them are the bits of the smallest normal number.
    return sign | static_cast<std::uint16_t>(std::nearbyint(std::abs(value) * 0x1p24f));
  }
  magnitude += 0xfff + ((magnitude >> 13) & 1);
  return sign | static_cast<std::uint16_t>((magnitude - kExponentShift) >> 13);
}

float float_from_half(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 31, mantissa = bits & 1023;
  float magnitude = 0;
  if (exponent == 31) {
    magnitude = mantissa != 0 ? std::numeric_limits<float>::quiet_NaN()
                              : std::numeric_limits<float>::infinity();
  } else if (exponent == 0) {
    magnitude = std::ldexp(static_cast<float>(mantissa), -24);
  } else {
    magnitude = std::ldexp(static_cast<float>(mantissa + 1024), exponent - 25);
  }
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

}  // namespace pharos

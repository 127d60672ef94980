#pragma once

#include <cmath>
#include <cstdint>

namespace pharos {

/// The fraction of `v`, |v| below 2^31, rounded to a multiple of 2^-24 on the torus: below one.
inline float wrapped(double v) {
  const auto nearest = static_cast<std::int64_t>(std::floor(v * 0x1p24 + 0.5));
  return static_cast<float>(nearest & 0xffffff) * 0x1p-24f;
}

}  // namespace pharos

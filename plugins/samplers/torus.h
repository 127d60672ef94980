#pragma once

#include <cmath>
#include <cstdint>

namespace pharos {

/// The fraction of `v`, |v| below 2^31, cut to a multiple of 2^-24 and so below one.
inline float wrapped(double v) {
  const auto cut = static_cast<std::int64_t>(std::floor(v * 0x1p24));
  return static_cast<float>(cut & 0xffffff) * 0x1p-24f;
}

}  // namespace pharos

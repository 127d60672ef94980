#pragma once

#include <cstdint>
#include <optional>

#include <pharos/config/schema.h>

namespace pharos {

/// How much work a render may do: samples a pixel, or wall-clock seconds; exactly one is set.
struct Budget {
  std::optional<std::uint32_t> spp;
  std::optional<double> seconds;

  static void describe(Schema<Budget>& schema);
};

}  // namespace pharos

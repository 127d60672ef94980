#pragma once

#include <cstdint>
#include <optional>

#include <pharos/config/schema.h>

namespace pharos {

/// The budget of a render: samples per pixel or wall-clock seconds. Exactly one of them is set.
struct Budget {
  std::optional<std::uint32_t> spp;
  std::optional<double> seconds;

  static void describe(Schema<Budget>& schema);
};

}  // namespace pharos

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/core/pixel_rect.h>
#include <pharos/rendering/integrator.h>

namespace pharos {

/// The work units of one or several passes of an iteration, numbered in order. Large passes are
/// divided into chunks of samples. The units of a chunk cover all tiles before the units of the
/// next chunk.
class UnitPlan {
 public:
  UnitPlan(const std::vector<PixelRect>& tiles, std::uint32_t iteration)
      : tiles_(&tiles), iteration_(iteration) {}

  /// Returns the number of work units in a pass of `samples` samples per pixel that has units of at
  /// most `unit`.
  static std::size_t units_of(std::uint32_t samples, std::uint32_t unit, std::size_t tiles) {
    return (samples + unit - 1) / unit * tiles;
  }

  /// Adds a pass that follows `done` samples of the iteration, without its first `skipped` units.
  void add(std::uint32_t done, std::uint32_t samples, std::uint32_t unit, std::size_t skipped = 0);

  std::size_t count() const { return count_; }
  WorkUnit operator[](std::size_t i) const;

 private:
  struct Pass {
    std::size_t first, skipped;  ///< number of its first unit here, and units that come before it
    std::uint32_t done, samples, unit;
  };

  const std::vector<PixelRect>* tiles_;
  std::uint32_t iteration_;
  std::vector<Pass> passes_;
  std::size_t count_ = 0;
};

}  // namespace pharos

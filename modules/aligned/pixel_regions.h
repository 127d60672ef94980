#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/sampler.h>

namespace pharos::aligned {

/// The pixels of a film divided into regions, which share the directions of their integrands
/// (section 5.3 of the paper). Pixels are numbered row by row.
class PixelRegions {
 public:
  PixelRegions() = default;
  /// `region_of[i]` is the number of the region that pixel i is in; numbers may be anything.
  explicit PixelRegions(std::span<const std::uint32_t> region_of);

  std::size_t count() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  std::size_t pixel_count() const { return region_of_.size(); }
  /// The region of a pixel, below count(); regions are numbered by their first pixels.
  std::uint32_t of(std::size_t pixel) const { return region_of_[pixel]; }
  /// The pixels of a region, ascending.
  std::span<const std::uint32_t> pixels(std::size_t region) const {
    return std::span(pixels_).subspan(starts_[region], starts_[region + 1] - starts_[region]);
  }

 private:
  std::vector<std::uint32_t> region_of_;
  std::vector<std::uint32_t> pixels_;  ///< region after region
  std::vector<std::size_t> starts_;    ///< in `pixels_`, and its end
};

/// Square blocks of `edge` pixels, those at the right and lower border smaller.
PixelRegions block_regions(const PixelGrid& grid, int edge);

/// When two first hits are of one surface.
struct SurfaceSettings {
  float angle = 15;           ///< most between their normals [degrees]
  float depth = 0.25f;        ///< most difference of their depths over the smaller one [1]
  std::uint32_t fewest = 32;  ///< smaller regions join others [pixels]

  static void describe(Schema<SurfaceSettings>& schema);
};

/// The same blocks, divided by what their pixels see: pixels of one surface are a region.
/// Regions of too few pixels join the largest of the same surface in a neighboring block, those
/// that find none the largest one of their block. Pixels that see nothing are alike.
PixelRegions surface_regions(const IntegrandProbe& probe, int edge,
                             const SurfaceSettings& settings);

}  // namespace pharos::aligned

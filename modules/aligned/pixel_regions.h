#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/sampler.h>

namespace pharos::aligned {

/// A partition of the pixels of a film into regions. The pixels of a region share the directions of
/// their integrands (section 5.3 of the paper). Pixels are numbered row by row.
class PixelRegions {
 public:
  PixelRegions() = default;
  /// `region_of[i]` is the label of the region that contains pixel i. Labels may be arbitrary
  /// numbers.
  explicit PixelRegions(std::span<const std::uint32_t> region_of);

  std::size_t count() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  std::size_t pixel_count() const { return region_of_.size(); }
  /// Returns the region of a pixel, a number below count(). Regions are numbered in the order of
  /// their first pixels.
  std::uint32_t of(std::size_t pixel) const { return region_of_[pixel]; }
  /// Returns the pixels of a region in ascending order.
  std::span<const std::uint32_t> pixels(std::size_t region) const {
    return std::span(pixels_).subspan(starts_[region], starts_[region + 1] - starts_[region]);
  }

 private:
  std::vector<std::uint32_t> region_of_;
  std::vector<std::uint32_t> pixels_;  ///< pixels of all regions, one region after the other
  std::vector<std::size_t> starts_;    ///< first index of each region in `pixels_`, and the end
};

/// Divides the film into square blocks of `edge` pixels. Blocks at the right and lower border are
/// smaller.
PixelRegions block_regions(const PixelGrid& grid, int edge);

/// The conditions under which two first hits lie on the same surface.
struct SurfaceSettings {
  float angle = 15;     ///< largest angle between their normals [degrees]
  float depth = 0.25f;  ///< largest difference of their depths, relative to the smaller depth [1]
  std::uint32_t fewest = 32;  ///< smallest size of a region; smaller regions join others [pixels]

  static void describe(Schema<SurfaceSettings>& schema);
};

/// Divides the same blocks by the surfaces that their pixels see: the pixels of one surface form a
/// region. A region with too few pixels joins the largest region of the same surface in a
/// neighboring block. If there is none, it joins the largest region of its own block. All pixels
/// that see nothing belong to one surface.
PixelRegions surface_regions(const IntegrandProbe& probe, int edge,
                             const SurfaceSettings& settings);

}  // namespace pharos::aligned

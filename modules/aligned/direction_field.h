#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <pharos/sampling/integrand_probe.h>

#include "directions.h"
#include "pixel_regions.h"
#include "principal_directions.h"

namespace pharos::aligned {

/// How the directions of integrands are estimated.
struct EstimationSettings {
  int block = 16;                           ///< edge of a block [pixels]
  std::optional<SurfaceSettings> surfaces;  ///< divides blocks by surface; none: they stay whole
  ProbeGrid grid;
  EdgeSettings edges;
  PrincipalSettings principal;
  bool reuse = false;  ///< whether what was looked at counts in the image

  static void describe(Schema<EstimationSettings>& schema);
};

/// What numbers are aligned with, everywhere on a film.
class DirectionField {
 public:
  /// `directions`: those of the first dimension region by region, then of the next.
  DirectionField(PixelRegions regions, std::vector<Dimension> dimensions,
                 std::vector<FreeDirections> directions, std::vector<FilmSample> samples = {})
      : regions_(std::move(regions)),
        dimensions_(std::move(dimensions)),
        directions_(std::move(directions)),
        samples_(std::move(samples)) {}

  const PixelRegions& regions() const { return regions_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  /// Of a dimension, by its place in dimensions(), in a region.
  const FreeDirections& at(std::size_t dimension, std::size_t region) const {
    return directions_[dimension * regions_.count() + region];
  }
  /// Estimates of the image: one of each tile of light samples, with `reuse`.
  const std::vector<FilmSample>& samples() const { return samples_; }

 private:
  PixelRegions regions_;
  std::vector<Dimension> dimensions_;
  std::vector<FreeDirections> directions_;
  std::vector<FilmSample> samples_;
};

/// Looks at the integrands of `dimensions` and finds at most `most` principal directions in each
/// region that has a pixel in the probe's window; there are none in others. Of each region
/// grid.size() points are probed, whatever its size, of grid.tile_count() pixels. All other numbers
/// of a path are held, and only its light up to the vertex after the one that the number decides on
/// counts, as later ones would be noise. The same for any number of threads; `seed` decides on all
/// that is random.
DirectionField estimate_directions(const IntegrandProbe& probe, std::vector<Dimension> dimensions,
                                   const EstimationSettings& settings, int most,
                                   std::uint64_t seed);

}  // namespace pharos::aligned

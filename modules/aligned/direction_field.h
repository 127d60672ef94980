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

/// Settings of the estimation of directions.
struct EstimationSettings {
  int block = 16;                           ///< edge of a block [pixels]
  std::optional<SurfaceSettings> surfaces;  ///< divides blocks by surface; empty: whole blocks
  ProbeGrid grid;
  EdgeSettings edges;
  PrincipalSettings principal;
  bool reuse = false;  ///< whether probed samples count in the image

  static void describe(Schema<EstimationSettings>& schema);
};

/// The directions with which each dimension is aligned, for all pixels of a film.
class DirectionField {
 public:
  /// `directions` holds the directions of the first dimension, region by region, then the
  /// directions of the next dimension.
  DirectionField(PixelRegions regions, std::vector<Dimension> dimensions,
                 std::vector<FreeDirections> directions, std::vector<FilmSample> samples = {})
      : regions_(std::move(regions)),
        dimensions_(std::move(dimensions)),
        directions_(std::move(directions)),
        samples_(std::move(samples)) {}

  const PixelRegions& regions() const { return regions_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  /// The directions in a region. `dimension` is an index into dimensions().
  const FreeDirections& at(std::size_t dimension, std::size_t region) const {
    return directions_[dimension * regions_.count() + region];
  }
  /// Estimates of the image: with `reuse`, one for each tile of light samples.
  const std::vector<FilmSample>& samples() const { return samples_; }

 private:
  PixelRegions regions_;
  std::vector<Dimension> dimensions_;
  std::vector<FreeDirections> directions_;
  std::vector<FilmSample> samples_;
};

/// Probes the integrands of `dimensions` and estimates at most `most` principal directions in each
/// region that has a pixel in the probe's window. Other regions have no directions. Each region is
/// probed at grid.size() points, whatever its size, and these points belong to grid.tile_count()
/// pixels. All other random numbers of a path are held constant. Light is counted only up to the
/// vertex after the one that the dimension selects, because light from later vertices would be
/// noise. The result is the same for any number of threads. `seed` determines all random choices.
DirectionField estimate_directions(const IntegrandProbe& probe, std::vector<Dimension> dimensions,
                                   const EstimationSettings& settings, int most,
                                   std::uint64_t seed);

}  // namespace pharos::aligned

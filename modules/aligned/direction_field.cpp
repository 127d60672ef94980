#include "direction_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <pharos/core/parallel.h>

namespace pharos::aligned {
namespace {

/// The probed samples of one dimension in one region.
struct Sight {
  std::vector<float> values;        ///< values at all points of the grid, tile after tile
  std::vector<FilmSample> samples;  ///< samples that may count in the image
};

/// Probes one dimension of one region.
class RegionProbe {
 public:
  RegionProbe(const IntegrandProbe& probe, const ProbeGrid& grid,
              std::span<const std::uint32_t> pixels, Dimension dimension, std::uint64_t seed)
      : probe_(probe), grid_(grid), pixels_(pixels), dimension_(dimension), seed_(seed) {}

  /// Evaluates all points of the grid. Values that are not finite count as zero. Film samples are
  /// kept for lights only: for other dimensions, paths are cut after the next vertex and are
  /// therefore no samples of the image.
  Sight look(bool keeps_samples) const {
    const std::vector<std::uint32_t> pixels = tile_pixels();
    Sight sight;
    sight.values.reserve(grid_.size());
    std::vector<Rgb> colors(grid_.tile_size());
    for (int tile = 0; tile < grid_.tile_count(); ++tile) {
      const ProbeQuery tile_query = query(pixels[static_cast<std::size_t>(tile)], tile);
      const std::vector<Vec2> points = grid_.points(tile, seed_);
      probe_.evaluate(tile_query, points, colors);
      for (Rgb& color : colors) {
        if (!is_finite(color)) color = Rgb();
        sight.values.push_back(mean(color));
      }
      if (keeps_samples && dimension_.purpose() == Purpose::light_position) {
        sight.samples.push_back(film_sample(tile_query, points.front(), colors));
      }
    }
    return sight;
  }

 private:
  /// Returns the mean of a tile's light samples, together with all other light of the path that
  /// they share. The tile is a random one for its pixel, so the expected value of this mean is the
  /// value of the pixel.
  FilmSample film_sample(const ProbeQuery& query, Vec2 first, std::span<const Rgb> colors) const {
    Rgb sum;
    for (const Rgb color : colors) sum += color;
    FilmSample path = probe_.whole_path(query, first);
    path.radiance += sum / static_cast<float>(colors.size()) - colors.front();
    return path;
  }

  /// Chooses a pixel for each tile. The pixels are spread evenly over the region, and their
  /// positions are independent of the positions of the tiles.
  std::vector<std::uint32_t> tile_pixels() const {
    const auto tiles = static_cast<std::size_t>(grid_.tile_count());
    RandomStream random(seed_, tiles);
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = 0; i < tiles; ++i) {
      const double place = (static_cast<double>(i) + random.next_1d()) / static_cast<double>(tiles);
      chosen.push_back(
          pixels_[static_cast<std::size_t>(place * static_cast<double>(pixels_.size()))]);
    }
    for (std::size_t i = tiles; i-- > 1;) std::swap(chosen[i], chosen[random() % (i + 1)]);
    return chosen;
  }

  ProbeQuery query(std::uint32_t pixel, int tile) const {
    const auto width = static_cast<std::uint32_t>(probe_.grid().width);
    return {.x = static_cast<int>(pixel % width),
            .y = static_cast<int>(pixel / width),
            .dimension = dimension_,
            .others = {.seed = seed_, .index = pixel, .sample = static_cast<std::uint32_t>(tile)},
            .max_depth = static_cast<std::uint16_t>(dimension_.bounce() + 2)};
  }

  const IntegrandProbe& probe_;
  const ProbeGrid& grid_;
  std::span<const std::uint32_t> pixels_;
  Dimension dimension_;
  std::uint64_t seed_;
};

/// Returns for each region whether at least one of its pixels will be rendered.
std::vector<bool> rendered_regions(const PixelRegions& regions, const IntegrandProbe& probe) {
  const PixelRect window = probe.window();
  const int width = probe.grid().width;
  std::vector<bool> is_rendered(regions.count());
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      is_rendered[regions.of(static_cast<std::size_t>(y) * width + x)] = true;
    }
  }
  return is_rendered;
}

}  // namespace

DirectionField estimate_directions(const IntegrandProbe& probe, std::vector<Dimension> dimensions,
                                   const EstimationSettings& settings, int most,
                                   std::uint64_t seed) {
  PixelRegions regions = settings.surfaces
                             ? surface_regions(probe, settings.block, *settings.surfaces)
                             : block_regions(probe.grid(), settings.block);
  const std::vector<bool> is_rendered = rendered_regions(regions, probe);
  std::vector<FreeDirections> directions(dimensions.size() * regions.count());
  std::vector<std::vector<FilmSample>> samples(directions.size());
  parallel_for(directions.size(), [&](std::size_t i) {
    if (!is_rendered[i % regions.count()]) return;
    const Dimension dimension = dimensions[i / regions.count()];
    const std::size_t region = i % regions.count();
    const std::uint64_t key = hash_combine(hash_combine(mix_bits(seed), dimension.code()), region);
    const RegionProbe region_probe(probe, settings.grid, regions.pixels(region), dimension, key);
    Sight sight = region_probe.look(settings.reuse);
    directions[i] = principal_directions(
        direction_histogram(sight.values, settings.grid, settings.edges), settings.principal, most);
    samples[i] = std::move(sight.samples);
  });
  std::vector<FilmSample> all;
  for (const auto& some : samples) all.insert(all.end(), some.begin(), some.end());
  return {std::move(regions), std::move(dimensions), std::move(directions), std::move(all)};
}

}  // namespace pharos::aligned

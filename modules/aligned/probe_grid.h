#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/random.h>
#include <pharos/core/vec.h>

namespace pharos::aligned {

/// The points at which the integrand of a region is probed: a square grid of cells over the unit
/// square, with a random point in each cell. The grid is divided into square tiles. All points of a
/// tile belong to one pixel. Within a tile, the values are therefore one function of the two
/// numbers, without noise, no matter how far edges move from pixel to pixel.
struct ProbeGrid {
  int cells = 96;  ///< number of cells along an axis; a multiple of `tiles`
  int tiles = 3;   ///< number of tiles along an axis

  static void describe(Schema<ProbeGrid>& schema);

  int tile_count() const { return tiles * tiles; }
  /// Number of cells of a tile along an axis.
  int tile_edge() const { return cells / tiles; }
  std::size_t tile_size() const {
    return static_cast<std::size_t>(tile_edge()) * static_cast<std::size_t>(tile_edge());
  }
  std::size_t size() const { return tile_size() * static_cast<std::size_t>(tile_count()); }

  /// Returns the points of a tile, row by row, drawn with `seed`.
  std::vector<Vec2> points(int tile, std::uint64_t seed) const {
    const int x0 = tile % tiles * tile_edge(), y0 = tile / tiles * tile_edge();
    RandomStream random(seed, static_cast<std::uint64_t>(tile));
    std::vector<Vec2> all;
    all.reserve(tile_size());
    for (int y = y0; y < y0 + tile_edge(); ++y) {
      for (int x = x0; x < x0 + tile_edge(); ++x) {
        const Vec2 u = random.next_2d();
        all.push_back({within(static_cast<float>(x) + u.x), within(static_cast<float>(y) + u.y)});
      }
    }
    return all;
  }

 private:
  /// Maps a position in cells to a number in [0, 1).
  float within(float place) const {
    return std::min(place / static_cast<float>(cells), kOneMinusEpsilon);
  }
};

}  // namespace pharos::aligned

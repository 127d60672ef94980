#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/random.h>
#include <pharos/core/vec.h>

namespace pharos::aligned {

/// Where the integrand of a region is looked at: a square grid of cells over the unit square, a
/// random point in each. The grid is divided into square tiles. All points of a tile are of one
/// pixel, so that within it the values are one function of the two numbers, without noise, however
/// far edges move from pixel to pixel.
struct ProbeGrid {
  int cells = 96;  ///< along an axis; a multiple of `tiles`
  int tiles = 3;   ///< along an axis

  static void describe(Schema<ProbeGrid>& schema);

  int tile_count() const { return tiles * tiles; }
  /// Cells of a tile along an axis.
  int tile_edge() const { return cells / tiles; }
  std::size_t tile_size() const {
    return static_cast<std::size_t>(tile_edge()) * static_cast<std::size_t>(tile_edge());
  }
  std::size_t size() const { return tile_size() * static_cast<std::size_t>(tile_count()); }

  /// The points of a tile, row by row, as `seed` draws them.
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
  /// A place in cells as a number of [0, 1).
  float within(float place) const {
    return std::min(place / static_cast<float>(cells), kOneMinusEpsilon);
  }
};

}  // namespace pharos::aligned

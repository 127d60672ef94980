#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

/// Sets of points whose spectra have low energy in stated directions, as they are stored and used.
namespace pharos::aligned {

/// A point of the unit square in steps of 2^-16: the middle of one of 65,536 x 65,536 cells, so
/// that mirrored points are points of the grid, too.
struct GridPoint {
  std::uint16_t x = 0, y = 0;

  /// In (0, 1)^2, exact.
  constexpr Vec2 position() const {
    return {(static_cast<float>(x) + 0.5f) * 0x1p-16f, (static_cast<float>(y) + 0.5f) * 0x1p-16f};
  }
  friend constexpr bool operator==(GridPoint, GridPoint) = default;
};

/// The point of the grid in whose cell (x, y) lies, both modulo one.
GridPoint grid_point(double x, double y);

using PointSet = std::vector<GridPoint>;

/// The positions of all points.
std::vector<Vec2> positions(std::span<const GridPoint> points);

/// A symmetry of the square that maps its axes to its axes: coordinates may change places, and then
/// x may become 1 - x.
struct Symmetry {
  bool swaps = false, mirrors = false;

  /// The direction [degrees] that lines of `direction` get, from 0 to 179 for whole ones from 0 to
  /// 179. Applied twice it gives the same direction again.
  constexpr int operator()(int direction) const {
    if (swaps) direction = 90 - direction;
    if (mirrors) direction = 180 - direction;
    return (direction + 360) % 180;
  }
  constexpr GridPoint operator()(GridPoint p) const {
    if (swaps) p = {p.y, p.x};
    if (mirrors) p.x = static_cast<std::uint16_t>(0xffff - p.x);
    return p;
  }
};

}  // namespace pharos::aligned

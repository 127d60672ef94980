#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

/// Point sets whose spectra have low energy along stated directions, as they are stored and used.
namespace pharos::aligned {

/// A point of the unit square on a grid with a spacing of 2^-16: the center of one of 65,536 x
/// 65,536 cells. Mirrored points are therefore points of the grid, too.
struct GridPoint {
  std::uint16_t x = 0, y = 0;

  /// The position in (0, 1)^2, exact.
  constexpr Vec2 position() const {
    return {(static_cast<float>(x) + 0.5f) * 0x1p-16f, (static_cast<float>(y) + 0.5f) * 0x1p-16f};
  }
  friend constexpr bool operator==(GridPoint, GridPoint) = default;
};

/// Returns the point of the grid whose cell contains (x, y). Both coordinates count modulo one.
GridPoint grid_point(double x, double y);

using PointSet = std::vector<GridPoint>;

/// Returns the positions of all points.
std::vector<Vec2> positions(std::span<const GridPoint> points);

/// A symmetry of the square that maps the axes to the axes. First, the coordinates may be swapped;
/// then x may be mirrored to 1 - x.
struct Symmetry {
  bool swaps = false, mirrors = false;

  /// Maps the direction of a line [degrees], a whole number from 0 to 179, to its direction after
  /// the symmetry is applied, also from 0 to 179. Applied twice, the function returns the original
  /// direction.
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

#include "point_set.h"

#include <cmath>

namespace pharos::aligned {
namespace {

/// A number just below a whole number may give 65,536, which wraps around to zero.
std::uint16_t cell_of(double u) {
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>((u - std::floor(u)) * 0x1p16));
}

}  // namespace

GridPoint grid_point(double x, double y) {
  return {cell_of(x), cell_of(y)};
}

std::vector<Vec2> positions(std::span<const GridPoint> points) {
  std::vector<Vec2> all;
  all.reserve(points.size());
  for (const GridPoint p : points) all.push_back(p.position());
  return all;
}

}  // namespace pharos::aligned

#pragma once

#include <cstddef>
#include <vector>

namespace pharos::aligned {

/// Two numbers per point: positions in the plane [sides of the unit square], or derivatives with
/// respect to positions.
struct Coordinates {
  std::vector<double> x, y;

  Coordinates() = default;
  /// Makes `count` pairs of zeros.
  explicit Coordinates(std::size_t count) : x(count), y(count) {}

  std::size_t size() const { return x.size(); }
};

}  // namespace pharos::aligned

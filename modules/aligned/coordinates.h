#pragma once

#include <cstddef>
#include <vector>

namespace pharos::aligned {

/// Numbers a point: positions in the plane [sides of the unit square], or derivatives by them.
struct Coordinates {
  std::vector<double> x, y;

  Coordinates() = default;
  /// All zero.
  explicit Coordinates(std::size_t count) : x(count), y(count) {}

  std::size_t size() const { return x.size(); }
};

}  // namespace pharos::aligned

#pragma once

#include <algorithm>
#include <array>
#include <compare>

/// Directions in the plane of two primary numbers. A direction is a whole number of degrees in [0,
/// 180), measured from the first number's axis toward the second number's axis. Directions are
/// axial: theta and theta + 180 are the same direction. The direction of an edge is the direction
/// of its normal, because the power spectrum of an integrand with this edge is high along the
/// normal.
namespace pharos::aligned {

inline constexpr int kDirections = 180;

/// Returns the angle between two directions, 0 to 90 degrees.
constexpr int degrees_between(int a, int b) {
  const int difference = a > b ? a - b : b - a;
  return std::min(difference, kDirections - difference);
}

/// Returns the angle between a direction and the nearer axis, 0 to 45 degrees.
constexpr int degrees_from_axis(int direction) {
  return std::min(degrees_between(direction, 0), degrees_between(direction, 90));
}

/// Maps any whole number of degrees to a direction.
constexpr int as_direction(int degrees) {
  return (degrees % kDirections + kDirections) % kDirections;
}

/// The largest number of directions, in addition to the axes, with which a point set is aligned.
inline constexpr int kMostFree = 2;

/// The directions, in addition to the axes, with which one dimension in one region is aligned, in
/// ascending order.
struct FreeDirections {
  int count = 0;                         ///< 0: the dimension is not aligned
  std::array<int, kMostFree> degrees{};  ///< elements from `count` on are zero

  const int* begin() const { return degrees.data(); }
  const int* end() const { return degrees.data() + count; }
  /// Adds a direction. There must be fewer than kMostFree directions.
  void add(int direction) {
    int* const last = degrees.data() + count++;
    int* const place = std::upper_bound(degrees.data(), last, direction);
    std::copy_backward(place, last, last + 1);
    *place = direction;
  }
  friend auto operator<=>(const FreeDirections&, const FreeDirections&) = default;
};

}  // namespace pharos::aligned

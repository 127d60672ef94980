#pragma once

#include <algorithm>
#include <array>
#include <compare>

/// Directions of the plane of two primary numbers. They are whole degrees in [0, 180), from the
/// first number's axis towards the second's, and axial: theta and theta + 180 are one direction.
/// The direction of an edge is that of its normal, along which the power spectrum of an integrand
/// with the edge is high.
namespace pharos::aligned {

inline constexpr int kDirections = 180;

/// The angle between two directions, 0 to 90 degrees.
constexpr int degrees_between(int a, int b) {
  const int difference = a > b ? a - b : b - a;
  return std::min(difference, kDirections - difference);
}

/// The angle between a direction and the nearer axis, 0 to 45 degrees.
constexpr int degrees_from_axis(int direction) {
  return std::min(degrees_between(direction, 0), degrees_between(direction, 90));
}

/// Any whole number of degrees as a direction.
constexpr int as_direction(int degrees) {
  return (degrees % kDirections + kDirections) % kDirections;
}

/// The most directions beside the axes that a point set is aligned with.
inline constexpr int kMostFree = 2;

/// The directions beside the axes that one number of one region is aligned with, ascending.
struct FreeDirections {
  int count = 0;                         ///< 0: there is nothing to align with
  std::array<int, kMostFree> degrees{};  ///< those from `count` on are zero

  const int* begin() const { return degrees.data(); }
  const int* end() const { return degrees.data() + count; }
  /// Adds one more, of fewer than kMostFree.
  void add(int direction) {
    int* const last = degrees.data() + count++;
    int* const place = std::upper_bound(degrees.data(), last, direction);
    std::copy_backward(place, last, last + 1);
    *place = direction;
  }
  friend auto operator<=>(const FreeDirections&, const FreeDirections&) = default;
};

}  // namespace pharos::aligned

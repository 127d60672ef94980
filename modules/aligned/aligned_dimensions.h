#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/sampling/dimension.h>

namespace pharos::aligned {

/// Returns whether numbers of this purpose can be aligned with edges: numbers of the lens, and
/// numbers of lights and directions at the first hit.
constexpr bool can_be_aligned(Purpose purpose) {
  return purpose == Purpose::lens || purpose == Purpose::light_position ||
         purpose == Purpose::bsdf_direction;
}

/// Returns the dimensions of these purposes. Each purpose must satisfy can_be_aligned().
/// light_position has `lights` branches, and each branch is a dimension.
std::vector<Dimension> aligned_dimensions(std::span<const Purpose> purposes, int lights);

/// Finds the index of a dimension in a list of aligned dimensions quickly.
class DimensionPlaces {
 public:
  /// `dimensions` is a subset of aligned_dimensions(), in the same order.
  explicit DimensionPlaces(std::span<const Dimension> dimensions);

  /// Returns the index of the dimension, or -1 if it is not in the list.
  int find(Dimension dimension) const {
    const Branches& b = branches_[static_cast<std::size_t>(dimension.purpose())];
    // The codes of two bounces differ by more than the number of branches, in either direction.
    const std::uint64_t branch = (dimension.code() - b.first_code) >> 8;
    return branch < b.count ? static_cast<int>(b.first_place + branch) : -1;
  }

 private:
  /// The dimensions of one purpose.
  struct Branches {
    std::uint64_t first_code = 0;
    std::uint32_t count = 0;
    std::uint32_t first_place = 0;
  };

  std::array<Branches, kPurposeCount> branches_;
};

}  // namespace pharos::aligned

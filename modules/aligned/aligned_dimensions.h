#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/sampling/dimension.h>

namespace pharos::aligned {

/// Whether numbers of this purpose can be aligned with edges: those of the lens, and of lights and
/// directions at the first hit.
constexpr bool can_be_aligned(Purpose purpose) {
  return purpose == Purpose::lens || purpose == Purpose::light_position ||
         purpose == Purpose::bsdf_direction;
}

/// The dimensions of these purposes, each of which can_be_aligned(); of light_position those of
/// `lights` branches.
std::vector<Dimension> aligned_dimensions(std::span<const Purpose> purposes, int lights);

/// Tells fast the place of a dimension in a list of aligned ones.
class DimensionPlaces {
 public:
  /// `dimensions` are some of aligned_dimensions(), in that order.
  explicit DimensionPlaces(std::span<const Dimension> dimensions);

  /// -1 when the dimension is not in the list.
  int find(Dimension dimension) const {
    const Branches& b = branches_[static_cast<std::size_t>(dimension.purpose())];
    // Another bounce is further away than there are branches, in either direction.
    const std::uint64_t branch = (dimension.code() - b.first_code) >> 8;
    return branch < b.count ? static_cast<int>(b.first_place + branch) : -1;
  }

 private:
  /// Those of one purpose.
  struct Branches {
    std::uint64_t first_code = 0;
    std::uint32_t count = 0;
    std::uint32_t first_place = 0;
  };

  std::array<Branches, kPurposeCount> branches_;
};

}  // namespace pharos::aligned

#include "aligned_dimensions.h"

#include <algorithm>

namespace pharos::aligned {

std::vector<Dimension> aligned_dimensions(std::span<const Purpose> purposes, int lights) {
  std::vector<Dimension> all;
  for (const Purpose purpose : purposes) {
    const bool is_light = purpose == Purpose::light_position;
    const std::uint16_t bounce = purpose == Purpose::lens ? 0 : 1;
    const int branches = is_light ? lights : 1;
    for (int branch = 0; branch < branches; ++branch) {
      const Dimension dimension{purpose, bounce, static_cast<std::uint16_t>(branch)};
      if (std::find(all.begin(), all.end(), dimension) == all.end()) all.push_back(dimension);
    }
  }
  return all;
}

DimensionPlaces::DimensionPlaces(std::span<const Dimension> dimensions) {
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    Branches& b = branches_[static_cast<std::size_t>(dimensions[i].purpose())];
    if (b.count == 0) b = {dimensions[i].code(), 0, static_cast<std::uint32_t>(i)};
    ++b.count;
  }
}

}  // namespace pharos::aligned

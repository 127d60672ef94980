#include "pixel_regions.h"

#include <unordered_map>

namespace pharos::aligned {

PixelRegions::PixelRegions(std::span<const std::uint32_t> region_of) {
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  std::vector<std::size_t> sizes;
  region_of_.reserve(region_of.size());
  for (const std::uint32_t label : region_of) {
    const auto next = static_cast<std::uint32_t>(sizes.size());
    const auto [entry, is_new] = numbers.try_emplace(label, next);
    if (is_new) sizes.push_back(0);
    ++sizes[entry->second];
    region_of_.push_back(entry->second);
  }
  starts_.push_back(0);
  for (const std::size_t size : sizes) starts_.push_back(starts_.back() + size);
  pixels_.resize(region_of_.size());
  std::vector<std::size_t> ends(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < region_of_.size(); ++i) {
    pixels_[ends[region_of_[i]]++] = static_cast<std::uint32_t>(i);
  }
}

PixelRegions block_regions(const PixelGrid& grid, int edge) {
  const int columns = (grid.width + edge - 1) / edge;
  std::vector<std::uint32_t> blocks;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      blocks.push_back(static_cast<std::uint32_t>(y / edge * columns + x / edge));
    }
  }
  return PixelRegions(blocks);
}

}  // namespace pharos::aligned

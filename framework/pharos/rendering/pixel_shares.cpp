#include <algorithm>
#include <utility>

#include <pharos/rendering/pixel_shares.h>

namespace pharos {

std::uint64_t PixelShares::count(const PixelRect& pixels, std::uint32_t first,
                                 std::uint32_t samples) const {
  if (are_even()) return static_cast<std::uint64_t>(pixels.area()) * samples;
  std::uint64_t sum = 0;
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      sum += count(x, y, first + samples) - count(x, y, first);
    }
  }
  return sum;
}

void PixelShares::archive(Archive& archive) {
  archive(window_.x0, window_.y0, window_.x1, window_.y1);
  archive.block(shares_);
  const bool fits = shares_.empty() || shares_.size() == window_.area();
  archive.expect(fits && std::ranges::all_of(shares_, [](float share) { return share > 0; }),
                 "the shares of the pixels");
}

}  // namespace pharos

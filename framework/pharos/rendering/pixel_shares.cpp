#include <algorithm>
#include <cmath>

#include <pharos/rendering/pixel_shares.h>

namespace pharos {

void PixelShares::archive(Archive& archive) {
  archive(window_.x0, window_.y0, window_.x1, window_.y1);
  archive.block(shares_);
  const bool fits = shares_.empty() || shares_.size() == window_.area();
  archive.expect(
      fits && std::ranges::all_of(shares_,
                                  [](float share) { return share > 0 && std::isfinite(share); }),
      "the shares of the pixels");
}

}  // namespace pharos

#include <algorithm>
#include <cmath>

#include <pharos/core/saved_rect.h>
#include <pharos/rendering/pixel_shares.h>

namespace pharos {

void PixelShares::archive(Archive& archive) {
  archive_rect(archive, window_);
  archive.block(shares_);
  const bool fits = shares_.empty() || shares_.size() == window_.area();
  archive.expect(
      fits && std::ranges::all_of(shares_,
                                  [](float share) { return share > 0 && std::isfinite(share); }),
      "the shares of the pixels");
}

}  // namespace pharos

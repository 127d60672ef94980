#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>

namespace pharos {

/// How many samples the pixels of a film get in an iteration, relative to the mean of all pixels.
/// Shares must not depend on the samples of the iteration itself: if noisy pixels got more samples
/// while they are rendered, their mean would be biased.
class PixelShares {
 public:
  /// Every pixel gets the same number.
  PixelShares() = default;
  /// `shares` are positive, one for each pixel of the window, row by row, with a mean of 1.
  PixelShares(const PixelRect& window, std::vector<float> shares)
      : window_(window), shares_(std::move(shares)) {}

  bool are_even() const { return shares_.empty(); }
  /// Returns the share of a pixel of the window [1].
  float at(int x, int y) const { return are_even() ? 1.0f : shares_[window_.index(x, y)]; }
  /// Returns how many samples a pixel of the window has when the mean is `samples`. It has one
  /// sample at least if `samples` is not 0.
  std::uint32_t count(int x, int y, std::uint32_t samples) const {
    if (are_even() || samples == 0) return samples;
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    const double own = std::floor(double{at(x, y)} * samples + 0.5);
    return static_cast<std::uint32_t>(std::clamp(own, 1.0, kMost));
  }

  void archive(Archive& archive);

 private:
  PixelRect window_;
  std::vector<float> shares_;  ///< empty: all are 1
};

}  // namespace pharos

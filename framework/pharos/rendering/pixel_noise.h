#pragma once

#include <vector>

#include <pharos/core/archive.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/pixel_shares.h>

namespace pharos {

/// Learns from the images of training how noisy the pixels are, and how to divide the samples of
/// the final image among them.
///
/// The mean over all pixels of variance / brightness is least if the number of samples is in
/// proportion to s / sqrt(brightness), where s is the standard deviation of a sample. This measure
/// is halfway between the mean squared error and its quotient by the squared brightness. Half of
/// the samples go to all pixels alike. So the variance of a pixel is at most about twice that of
/// even shares, and what was learned from few samples does little harm.
///
/// Noise and brightness are averaged over a square of pixels. It grows until the effective number
/// of its samples, (sum of values)^2 / (sum of squared values) (Kish 1965), is at least 8. Where
/// few samples have found light, the square is so large that the shares are even. The brightness
/// does not contain splats.
class PixelNoise {
 public:
  /// Adds the samples of a training iteration. As guides get better, earlier iterations tell less:
  /// they count a quarter.
  void add(const Film& film);
  /// Returns the shares for the final image on a film like those that were added. They are even as
  /// long as nothing is known.
  PixelShares shares() const;
  /// Returns the window of the films that were added; it is empty if there were none.
  const PixelRect& window() const { return window_; }

  void archive(Archive& archive);

 private:
  /// Weighted sums over the samples of a pixel. Values are luminances.
  struct Pixel {
    double weight = 0, squared_weights = 0;
    double value = 0, squares = 0;
  };
  struct Sums;
  class Table;

  PixelRect window_;
  std::vector<Pixel> pixels_;
};

}  // namespace pharos

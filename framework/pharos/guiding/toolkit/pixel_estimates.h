#pragma once

#include <cstddef>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

namespace pharos {

/// Estimates of pixel values, for learners whose samples count relative to their pixel: blurred
/// means over all paths so far.
class PixelEstimates {
 public:
  /// Keeps estimates for the pixels of a window of the film. A path that ends outside of the window
  /// counts for the nearest pixel of the window.
  explicit PixelEstimates(const PixelRect& window);

  /// Adds a path that ends at a position of the film [pixels] with this value, a number for all
  /// channels. `paths` is the number of paths for which it counts: the density of an even choice of
  /// film positions over the density with which the position was chosen, if a guide chose it.
  void add(Vec2 film, double value, double paths = 1);
  /// Updates the estimates with all paths so far. An estimate is the mean over (2 `radius` + 1)^2
  /// pixels, at least `least` times the mean of the whole image.
  void update(int radius, double least);
  /// Returns the estimate of the last update(). It is one everywhere until a path has found light.
  double at(Vec2 film) const;
  /// Returns the mean of the whole image at the last update(). It is one until a path has found
  /// light. In contrast to 1 / at(), the factor mean() / at() is comparable between iterations.
  double mean() const { return mean_; }

  /// Saves or loads the estimates. Loading requires estimates of the same size and throws
  /// InputError otherwise.
  void archive(Archive& archive);

 private:
  struct Pixel {
    double sum = 0, paths = 0;
    void archive(Archive& archive) { archive(sum, paths); }
  };
  std::size_t index(Vec2 film) const;
  /// Returns the sum over all pixels up to the last update().
  Pixel sum_of_all() const;
  /// Returns the sum over the pixels up to `radius` away along both axes.
  Pixel sum_around(int x, int y, int radius) const;

  PixelRect window_;
  std::vector<Pixel> pixels_;  ///< sums up to the last update()
  std::vector<Pixel> new_;     ///< sums since the last update()
  std::vector<double> estimates_;
  double mean_ = 1;
};

}  // namespace pharos

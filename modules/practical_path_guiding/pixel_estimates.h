#pragma once

#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

namespace pharos::practical_path_guiding {

/// Estimates of pixel values for the target `relative`: blurred means over all paths so far.
class PixelEstimates {
 public:
  /// Keeps estimates for the pixels of a window of the film. A path that ends outside of the window
  /// counts for the nearest pixel of the window.
  explicit PixelEstimates(const PixelRect& window);

  /// Adds a path that ends at a position of the film [pixels] with this value (mean of the
  /// channels).
  void add(Vec2 film, double value);
  /// Updates the estimates with all paths so far. An estimate is the mean over (2 `radius` + 1)^2
  /// pixels, at least `least` times the mean of the whole image.
  void update(int radius, double least);
  /// Returns the estimate of the last update(). It is one everywhere until a path has found light.
  double at(Vec2 film) const;

  /// Saves or loads the estimates. Loading requires estimates of the same size and throws
  /// InputError otherwise.
  void archive(Archive& archive);

 private:
  struct Pixel {
    double sum = 0, paths = 0;
    void archive(Archive& archive) { archive(sum, paths); }
  };
  std::size_t index(Vec2 film) const;
  /// Returns the sum over the pixels up to `radius` away along both axes.
  Pixel sum_around(int x, int y, int radius) const;

  PixelRect window_;
  std::vector<Pixel> pixels_;  ///< sums up to the last update()
  std::vector<Pixel> new_;     ///< sums since the last update()
  std::vector<double> estimates_;
};

}  // namespace pharos::practical_path_guiding

#pragma once

#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

namespace pharos::practical_path_guiding {

/// Estimates of the pixels' values: blurred means over all paths so far, for a target that is
/// relative to the image.
class PixelEstimates {
 public:
  /// Keeps estimates for the pixels of a window of the film. Paths that end outside of the window
  /// count for its nearest pixel.
  explicit PixelEstimates(const PixelRect& window);

  /// Adds a path that ends at a position of the film [pixels] with this value (mean of the
  /// channels).
  void add(Vec2 film, double value);
  /// Updates the estimates with all paths up to now: means over (2 `radius` + 1)^2 pixels, at least
  /// `least` times the mean of the whole image.
  void update(int radius, double least);
  /// Returns the estimate of the last update(); one everywhere until a path has brought light.
  double at(Vec2 film) const;

  /// Loads what one of the same size saved. Throws InputError for anything else.
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
  std::vector<Pixel> pixels_;  ///< up to the last update()
  std::vector<Pixel> new_;     ///< since the last update()
  std::vector<double> estimates_;
};

}  // namespace pharos::practical_path_guiding

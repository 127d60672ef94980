#pragma once

#include <iosfwd>
#include <vector>

#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

namespace pharos::practical_path_guiding {

/// What pixels look like so far: means over all paths, blurred, for a target that is relative to
/// the image.
class PixelEstimates {
 public:
  /// The pixels of a part of the film; what ends beyond counts for the nearest one.
  explicit PixelEstimates(const PixelRect& window);

  /// A path that ends at a place of the film [pixels] with this value (mean of the channels).
  void add(Vec2 film, double value);
  /// Makes at() say what was added up to now: means over (2 `radius` + 1)^2 pixels, not below
  /// `least` times the whole image's.
  void update(int radius, double least);
  /// As of the last update(); one everywhere before there is any light.
  double at(Vec2 film) const;

  /// Adds the paths that another one of the same size has, but for those that both began with.
  void merge(const PixelEstimates& other);
  void save(std::ostream& out) const;
  /// Reads what one of the same size saved. Throws InputError when it is something else.
  void load(std::istream& in);

 private:
  struct Pixel {
    double sum = 0, paths = 0;
  };
  std::size_t index(Vec2 film) const;
  /// Of the pixels up to `radius` away.
  Pixel sum_around(int x, int y, int radius) const;

  PixelRect window_;
  std::vector<Pixel> pixels_;  ///< up to the last update()
  std::vector<Pixel> new_;     ///< since then
  std::vector<double> estimates_;
};

}  // namespace pharos::practical_path_guiding

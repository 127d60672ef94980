#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include <pharos/core/color_image.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>

namespace pharos {

/// A position on the sphere of directions in the layout of latitude-longitude images. `u` in [0, 1)
/// runs about the +y axis from -z through +x, +z and -x. `v` in [0, 1] runs from +y to -y.
struct LatLong {
  float u = 0;
  float v = 0;
  /// (1 - y) / 2 in [0, 1], the share of the sphere above; a float would lose digits at the lower
  /// pole.
  double above = 0;

  /// The position of a unit direction.
  static LatLong of(Vec3 direction);
  /// The unit direction at `u` and `above`.
  static Vec3 direction(float u, double above);
};

/// The bilinear cell that contains a coordinate: between the pixel centers `low` and `low + 1`, at
/// the fraction `t` in [0, 1]. `low` is -1 before the first center. For every coordinate, including
/// NaN, it lies at most one pixel outside the image.
struct PixelPair {
  int low = 0;
  float t = 0;

  static PixelPair at(float coordinate, int pixels) {
    const float x = coordinate * static_cast<float>(pixels) - 0.5f;
    const float low = std::min(std::max(-1.0f, std::floor(x)), static_cast<float>(pixels - 1));
    return {static_cast<int>(low), x - low};
  }
};

/// A color for every direction: an image that wraps around in u and is clamped in v, bilinear
/// between the pixel centers ((column + 0.5) / width, (row + 0.5) / height).
class LatLongImage {
 public:
  /// Reads an image file. The color comes from the channels R, G, B or else Y; if there are no
  /// channels of these names, it comes from the first three channels or from the only one. Throws
  /// InputError as read_colors() does, and for values that are negative or not finite.
  explicit LatLongImage(const std::filesystem::path& file);
  /// Takes width x height `pixels` row by row, top row first. They must be finite and not negative.
  LatLongImage(int width, int height, const std::vector<Rgb>& pixels)
      : pixels_(width, height, pixels) {}

  int width() const { return pixels_.width(); }
  int height() const { return pixels_.height(); }
  Rgb pixel(int column, int row) const { return pixels_.pixel(column, row); }
  Rgb evaluate(const LatLong& place) const;

  /// Maps a column index that is at most one outside the image to the column it refers to;
  /// clamped() does the same for rows.
  int wrapped(int column) const { return column < 0 ? width() - 1 : column < width() ? column : 0; }
  int clamped(int row) const { return row < 0 ? 0 : row < height() ? row : height() - 1; }

 private:
  ColorImage pixels_;
};

}  // namespace pharos

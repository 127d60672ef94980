#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>

namespace pharos {

/// A place on the sphere of directions, as latitude-longitude images are laid out: `u` in [0, 1)
/// runs about the +y axis from -z through +x, +z and -x, `v` in [0, 1] from +y to -y.
struct LatLong {
  float u = 0;
  float v = 0;
  /// (1 - y) / 2 in [0, 1], the share of the sphere above; a float would lose the lower pole.
  double above = 0;

  /// Of a unit direction.
  static LatLong of(Vec3 direction);
  /// The unit direction at `u` and `above`.
  static Vec3 direction(float u, double above);
};

/// The bilinear cell that a coordinate lies in: between pixel centres `low` and `low + 1`, at the
/// fraction `t` in [0, 1] of the way. `low` is -1 before the first center, and never names a pixel
/// further outside, whatever the coordinate, NaN included.
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
/// between pixel centres ((column + 0.5) / width, (row + 0.5) / height).
class LatLongImage {
 public:
  /// Reads an image file; the color is that of channels R, G, B or else Y, without such names that
  /// of the first three channels or of the only one. Throws InputError as read_image() does, and
  /// for values that are negative or not finite.
  explicit LatLongImage(const std::filesystem::path& file);
  /// Of `pixels` row by row, top row first: width x height of them, finite and not negative.
  LatLongImage(int width, int height, std::vector<Rgb> pixels)
      : width_(width), height_(height), pixels_(std::move(pixels)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  Rgb pixel(int column, int row) const {
    return pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(column)];
  }
  Rgb evaluate(const LatLong& place) const;

  /// The column `column` stands for, at most one outside; rows likewise.
  int wrapped(int column) const { return column < 0 ? width_ - 1 : column < width_ ? column : 0; }
  int clamped(int row) const { return row < 0 ? 0 : row < height_ ? row : height_ - 1; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<Rgb> pixels_;
};

}  // namespace pharos

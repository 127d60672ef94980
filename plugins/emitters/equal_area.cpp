#include "equal_area.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

/// Returns a pixel of an n x n image, or of its continuation beyond an edge: there the square is
/// folded, so that the neighbors of an edge are its own pixels, mirrored about its middle.
Rgb folded_pixel(const ColorImage& image, int x, int y) {
  const int n = image.width();
  if (x < 0 || x >= n) {
    x = x < 0 ? -1 - x : 2 * n - 1 - x;
    y = n - 1 - y;
  }
  if (y < 0 || y >= n) {
    y = y < 0 ? -1 - y : 2 * n - 1 - y;
    x = n - 1 - x;
  }
  return image.pixel(std::clamp(x, 0, n - 1), std::clamp(y, 0, n - 1));
}

/// Returns the color at a point of the square, bilinear between the pixels' centers.
Rgb color_at(const ColorImage& image, Vec2 point) {
  const PixelPair across = PixelPair::at(point.x, image.width());
  const PixelPair down = PixelPair::at(point.y, image.height());
  const auto along = [&](int row) {
    return (1 - across.t) * folded_pixel(image, across.low, row) +
           across.t * folded_pixel(image, across.low + 1, row);
  };
  return (1 - down.t) * along(down.low) + down.t * along(down.low + 1);
}

}  // namespace

Vec2 equal_area_square(Vec3 d) {
  const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  const float radius = std::sqrt(std::max(0.0f, 1 - z));
  // The azimuth within the quadrant, as a share of a right angle.
  const float turn = x == 0 && y == 0 ? 0 : std::atan2(y, x) * 2 / kPi;
  float v = turn * radius, u = radius - v;
  if (d.z < 0) {  // the lower hemisphere is folded outwards
    std::swap(u, v);
    u = 1 - u;
    v = 1 - v;
  }
  return {(std::copysign(u, d.x) + 1) / 2, (std::copysign(v, d.y) + 1) / 2};
}

LatLongImage read_equal_area(const std::filesystem::path& file) {
  const ColorImage image = read_colors(file);
  check_colors(image, file);
  if (image.width() != image.height()) {
    throw InputError(
        fmt::format("'{}': an image in equal-area layout must be square, found {} x {}",
                    file.string(), image.width(), image.height()));
  }
  const int height = image.height(), width = 2 * height;
  std::vector<Rgb> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    const double above = (1 - std::cos(kPi * (row + 0.5) / height)) / 2;
    for (int column = 0; column < width; ++column) {
      const float u = (static_cast<float>(column) + 0.5f) / static_cast<float>(width);
      pixels.push_back(color_at(image, equal_area_square(LatLong::direction(u, above))));
    }
  }
  return {width, height, pixels};
}

}  // namespace pharos

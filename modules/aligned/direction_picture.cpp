#include "direction_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::aligned {
namespace {

/// The position of a region's segments [pixels of the picture].
struct Place {
  Vec2 center;
  float edge = 0;  ///< edge of a square that has the area of the region
};

Place place_of(std::span<const std::uint32_t> pixels, int width, int scale) {
  double x = 0, y = 0;
  for (const std::uint32_t pixel : pixels) {
    x += pixel % static_cast<std::uint32_t>(width) + 0.5;
    y += pixel / static_cast<std::uint32_t>(width) + 0.5;
  }
  const double factor = scale / static_cast<double>(pixels.size());
  return {{static_cast<float>(factor * x), static_cast<float>(factor * y)},
          static_cast<float>(scale) * std::sqrt(static_cast<float>(pixels.size()))};
}

/// Blends a segment of `direction` with round ends and smooth borders into the image.
void draw_segment(Image& image, const Place& place, int direction, Rgb color) {
  const float half_length = 0.4f * place.edge, half_width = std::max(0.03f * place.edge, 0.75f);
  const float angle = radians(static_cast<float>(direction));
  const Vec2 along{std::cos(angle), -std::sin(angle)};  // row numbers increase downward
  const int reach = static_cast<int>(std::ceil(half_length + half_width)) + 1;
  const int x0 = static_cast<int>(place.center.x), y0 = static_cast<int>(place.center.y);
  for (int y = std::max(y0 - reach, 0); y <= std::min(y0 + reach, image.height() - 1); ++y) {
    for (int x = std::max(x0 - reach, 0); x <= std::min(x0 + reach, image.width() - 1); ++x) {
      const Vec2 d =
          Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} - place.center;
      const float t = std::clamp(d.x * along.x + d.y * along.y, -half_length, half_length);
      const float distance = std::hypot(d.x - t * along.x, d.y - t * along.y);
      const float share = std::clamp(half_width + 0.5f - distance, 0.0f, 1.0f);
      image.set_rgb(x, y, (1 - share) * image.rgb(x, y) + share * color);
    }
  }
}

Image enlarged(const Image& render, int scale) {
  constexpr float kDarkened = 0.4f;
  Image image(render.width() * scale, render.height() * scale, {"R", "G", "B"});
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image.set_rgb(x, y, kDarkened * render.rgb(x / scale, y / scale));
    }
  }
  return image;
}

}  // namespace

Image direction_picture(const Image& render, const DirectionField& field, std::size_t dimension,
                        int scale) {
  constexpr std::array<Rgb, kMostFree> kColors{Rgb(3, 0.2f, 0.1f), Rgb(0.1f, 1.5f, 3)};
  Image image = enlarged(render, scale);
  for (std::size_t region = 0; region < field.regions().count(); ++region) {
    const Place place = place_of(field.regions().pixels(region), render.width(), scale);
    std::size_t number = 0;
    for (const int direction : field.at(dimension, region)) {
      draw_segment(image, place, direction, kColors[number++]);
    }
  }
  return image;
}

}  // namespace pharos::aligned

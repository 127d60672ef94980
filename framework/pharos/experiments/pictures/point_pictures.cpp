#include <algorithm>
#include <cmath>

#include <pharos/experiments/pictures/color_map.h>
#include <pharos/experiments/pictures/point_pictures.h>

namespace pharos {
namespace {

constexpr Rgb kPaper{1, 1, 1}, kEdge{0.5f, 0.5f, 0.5f}, kInk{0.01f, 0.015f, 0.03f};
constexpr int kGap = 12;  // gap between the pictures of a contact sheet [pixels]

void fill(Image& image, Rgb color) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.set_rgb(x, y, color);
  }
}

void draw_frame(Image& image, Rgb color) {
  for (int i = 0; i < image.width(); ++i) {
    image.set_rgb(i, 0, color), image.set_rgb(i, image.height() - 1, color);
  }
  for (int i = 0; i < image.height(); ++i) {
    image.set_rgb(0, i, color), image.set_rgb(image.width() - 1, i, color);
  }
}

/// Draws a disk with soft edges. Parts outside of the image are cut off.
void draw_disk(Image& image, Vec2 center, float radius, Rgb color) {
  const auto first = [&](float c) { return std::max(0, static_cast<int>(c - radius - 1)); };
  const auto last = [&](float c, int size) {
    return std::min(size - 1, static_cast<int>(c + radius + 1));
  };
  for (int y = first(center.y); y <= last(center.y, image.height()); ++y) {
    for (int x = first(center.x); x <= last(center.x, image.width()); ++x) {
      const float dx = static_cast<float>(x) + 0.5f - center.x;
      const float dy = static_cast<float>(y) + 0.5f - center.y;
      const float cover = std::clamp(radius + 0.5f - std::hypot(dx, dy), 0.0f, 1.0f);
      image.set_rgb(x, y, (1 - cover) * image.rgb(x, y) + cover * color);
    }
  }
}

}  // namespace

Image points_picture(std::span<const Vec2> points, int edge) {
  constexpr float kLeastRadius = 0.7f;  // [pixels]
  Image image(edge, edge, {"R", "G", "B"});
  fill(image, kPaper);
  draw_frame(image, kEdge);
  const auto size = static_cast<float>(edge);
  const float spacing = size / std::sqrt(static_cast<float>(points.size()));
  const float radius = std::max(kLeastRadius, std::min(0.13f * spacing, size / 100));
  for (const Vec2 p : points) {
    draw_disk(image, {size * p.x, size * (1 - p.y)}, radius, kInk);
  }
  return image;
}

Image spectrum_picture(const statistics::PowerSpectrum& spectrum, int edge) {
  const int highest = spectrum.max_frequency(), cells = 2 * highest + 1;
  Image powers(edge, edge, {"Y"});
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const int column = x * cells / edge, row = y * cells / edge;
      *powers.pixel(x, y) = static_cast<float>(spectrum.at(column - highest, highest - row));
    }
  }
  return false_color(powers, {.low = kLowestPower, .high = kHighestPower, .logarithmic = true});
}

Image contact_sheet(std::span<const Image> pictures, int columns) {
  if (pictures.empty()) return {};
  const int width = pictures.front().width() + kGap, height = pictures.front().height() + kGap;
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  Image sheet(columns * width - kGap, rows * height - kGap, {"R", "G", "B"});
  fill(sheet, kPaper);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int left = static_cast<int>(i) % columns * width;
    const int top = static_cast<int>(i) / columns * height;
    for (int y = 0; y < pictures[i].height(); ++y) {
      for (int x = 0; x < pictures[i].width(); ++x) {
        sheet.set_rgb(left + x, top + y, pictures[i].rgb(x, y));
      }
    }
  }
  return sheet;
}

}  // namespace pharos

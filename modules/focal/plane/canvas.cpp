#include "canvas.h"

#include <algorithm>
#include <cmath>

#include "stroke_font.h"

namespace pharos::focal::plane {
namespace {

/// Returns the share of pixel `i`, from i to i + 1, that lies between `low` and `high`.
double overlap(int i, double low, double high) {
  return std::clamp(std::min(i + 1.0, high) - std::max<double>(i, low), 0.0, 1.0);
}

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t =
      squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

Canvas::Canvas(int width, int height, Rgb background) : encoded_(width, height, {"R", "G", "B"}) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) encoded_.set_rgb(x, y, background);
  }
}

void Canvas::blend(int x, int y, const Ink& ink, double coverage) {
  if (x < 0 || y < 0 || x >= encoded_.width() || y >= encoded_.height()) return;
  const auto share = static_cast<float>(ink.opacity * coverage);
  encoded_.set_rgb(x, y, (1 - share) * encoded_.rgb(x, y) + share * ink.color);
}

void Canvas::rectangle(Point2 corner, Point2 opposite, const Ink& ink) {
  for (int y = static_cast<int>(std::floor(corner.y)); y < opposite.y; ++y) {
    for (int x = static_cast<int>(std::floor(corner.x)); x < opposite.x; ++x) {
      blend(x, y, ink, overlap(x, corner.x, opposite.x) * overlap(y, corner.y, opposite.y));
    }
  }
}

void Canvas::line(Point2 from, Point2 to, double width, const Ink& ink) {
  const double reach = 0.5 * width + 1;
  const bool steep = std::abs(to.y - from.y) > std::abs(to.x - from.x);
  // Walks along the longer axis `u`. For each u, it visits only the pixels across, `v`, that the
  // stroke can cover.
  const auto along = [steep](Point2 p) { return steep ? p.y : p.x; };
  const auto across = [steep](Point2 p) { return steep ? p.x : p.y; };
  if (along(to) < along(from)) std::swap(from, to);
  const double run = along(to) - along(from);
  const double slope = run > 0 ? (across(to) - across(from)) / run : 0;
  const double half = reach * std::sqrt(1 + slope * slope);
  for (int u = static_cast<int>(along(from) - reach); u <= along(to) + reach; ++u) {
    const double nearest = std::clamp(u + 0.5, along(from), along(to));
    const double middle = across(from) + slope * (nearest - along(from));
    for (int v = static_cast<int>(middle - half); v <= middle + half; ++v) {
      const int x = steep ? v : u, y = steep ? u : v;
      const double distance = distance_to_segment({x + 0.5, y + 0.5}, from, to);
      const double coverage = std::clamp(0.5 * width + 0.5 - distance, 0.0, std::min(width, 1.0));
      if (coverage > 0) blend(x, y, ink, coverage);
    }
  }
}

void Canvas::polyline(std::span<const Point2> points, double width, const Ink& ink) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], width, ink);
}

double Canvas::text(Point2 at, std::string_view letters, double height, const Ink& ink) {
  const double unit = height / kCapHeight;
  double advanced = 0;
  for (const char letter : letters) {
    const Glyph glyph = glyph_of(letter);
    for (std::vector<Point2> stroke : glyph.strokes) {
      for (Point2& p : stroke) p = {at.x + (advanced + p.x) * unit, at.y - p.y * unit};
      polyline(stroke, 0.13 * height, ink);
    }
    advanced += glyph.advance;
  }
  return advanced * unit;
}

Image Canvas::image() const {
  Image linear = encoded_;
  for (float& value : linear.values()) value = linear_from_srgb(value);
  return linear;
}

double text_width(std::string_view letters, double height) {
  double advanced = 0;
  for (const char letter : letters) advanced += glyph_of(letter).advance;
  return advanced * height / kCapHeight;
}

}  // namespace pharos::focal::plane

#include "picture.h"

#include <algorithm>
#include <cmath>

#include "canvas.h"

namespace pharos::focal::plane {
namespace {

constexpr Rgb kPaper{1, 1, 1}, kDark{0.11f, 0.13f, 0.18f}, kGray{0.52f, 0.54f, 0.58f};
constexpr Rgb kLight{0.96f, 0.73f, 0.18f};
// All lengths are in pixels.
constexpr double kUnit = 240;  // length of a scene unit
constexpr double kMargin = 22, kTitleHeight = 56, kFloorSpace = 40, kStripHeight = 168;
constexpr double kLetters = 17, kSmallLetters = 13;

/// Returns half of the width that the picture shows [scene units]: the whole scene, with space for
/// labels on both sides of the floor.
double seen_half_width(const GapScene& scene) {
  return std::max(scene.half_width(), scene.floor_half_width + 0.42);
}

/// The logarithmic scale of the strips.
struct Scale {
  double low = 0, high = 1;  ///< decimal logarithms of both ends

  /// Returns the position of a value: 0 at the lower end, 1 at the upper end.
  double position(double value) const { return (std::log10(value) - low) / (high - low); }
};

/// Returns a scale from the decade below the smallest variance to slightly above the largest
/// variance.
Scale scale_of(std::span<const Panel> panels, std::span<const double> uniform) {
  const auto [least, most] = std::minmax_element(uniform.begin(), uniform.end());
  double low = *least, high = *most;
  for (const Panel& panel : panels) {
    for (const double v : panel.variances) low = std::min(low, v), high = std::max(high, v);
  }
  return {std::floor(std::log10(low)), std::log10(high) + 0.2};
}

/// Draws one panel. The upper left corner of its scene is at (left, top).
class PanelDrawing {
 public:
  PanelDrawing(Canvas& canvas, const GapScene& scene, const Panel& panel, double left, double top)
      : canvas_(canvas), scene_(scene), panel_(panel), left_(left), top_(top) {}

  void draw_scene(double full_value) {
    if (panel_.tree != nullptr) tint();
    for (const Path& path : panel_.paths) {
      const double end = path.x + scene_.light_height * std::tan(path.angle);
      canvas_.line(to_pixels({path.x, 0}), to_pixels({end, scene_.light_height}), 1,
                   {kDark, std::min(path.value / full_value, 1.0)});
    }
    walls();
    canvas_.text({left_, top_ - 24}, panel_.title, kLetters, {kDark});
  }

  void draw_strip(const Scale& scale, std::span<const double> uniform) {
    axis(scale);
    curve(panel_.variances, scale);
    dashes(uniform, scale);
  }

 private:
  Point2 to_pixels(Point2 p) const {
    return {left_ + (p.x + seen_half_width(scene_)) * kUnit,
            top_ + (scene_.light_height - p.y) * kUnit};
  }
  double floor_left() const { return to_pixels({-scene_.floor_half_width, 0}).x; }
  double floor_right() const { return to_pixels({scene_.floor_half_width, 0}).x; }
  double strip_bottom() const {
    return top_ + scene_.light_height * kUnit + kFloorSpace + kStripHeight;
  }
  Point2 on_strip(double position, double value, const Scale& scale) const {
    const double height = std::clamp(scale.position(value), 0.0, 1.0) * kStripHeight;
    return {floor_left() + position * (floor_right() - floor_left()), strip_bottom() - height};
  }

  /// Tints the leaves. Each doubling of the density above a sixteenth of the mean is one step
  /// darker.
  void tint() {
    const double area = panel_.tree->region().area();
    panel_.tree->for_each_leaf([&](const Quadtree::Child& leaf, const Cell& cell, std::size_t) {
      const double doublings = std::log2(std::max(1.0, 16 * leaf.mass * area / cell.area()));
      const double opacity = std::min(0.05 * doublings, 0.75);
      const Point2 corner = to_pixels({cell.low.x, cell.low.y + cell.size.y});
      const Point2 opposite = to_pixels({cell.low.x + cell.size.x, cell.low.y});
      canvas_.rectangle(corner, opposite, {panel_.color, opacity});
    });
  }

  void walls() {
    const Point2 light = to_pixels({-scene_.light_half_width, scene_.light_height});
    canvas_.rectangle({light.x, light.y - 9},
                      {light.x + 2 * scene_.light_half_width * kUnit, light.y}, {kLight});
    const Point2 floor = to_pixels({0, 0});
    canvas_.rectangle({floor_left(), floor.y}, {floor_right(), floor.y + 6}, {kDark});
    double begin = -seen_half_width(scene_);
    for (const Interval& gap : scene_.gaps()) {
      obstacle(begin, gap.low);
      begin = gap.high;
    }
    obstacle(begin, seen_half_width(scene_));
  }
  void obstacle(double begin, double end) {
    const Point2 from = to_pixels({begin, scene_.obstacle_height});
    canvas_.rectangle({from.x, from.y - 2.5}, {to_pixels({end, 0}).x, from.y + 2.5}, {kDark});
  }

  void axis(const Scale& scale) {
    for (int exponent = static_cast<int>(scale.low); exponent <= scale.high; ++exponent) {
      const double value = std::pow(10.0, exponent);
      const Point2 from = on_strip(0, value, scale), to = on_strip(1, value, scale);
      canvas_.line(from, to, 1, {kGray, 0.4});
      const std::string power = std::to_string(exponent);
      const double width =
          text_width("10", kSmallLetters) + text_width(power, 0.75 * kSmallLetters);
      const Point2 at{from.x - width - 6, from.y + 0.5 * kSmallLetters};
      const double ten = canvas_.text(at, "10", kSmallLetters, {kGray});
      canvas_.text({at.x + ten, at.y - 6}, power, 0.75 * kSmallLetters, {kGray});
    }
    canvas_.text({left_, strip_bottom() - kStripHeight - 14}, "variance", kSmallLetters, {kGray});
  }

  void curve(std::span<const double> values, const Scale& scale) {
    const auto count = static_cast<double>(values.size());
    std::vector<Point2> points;
    for (std::size_t i = 0; i < values.size(); ++i) {
      points.push_back(on_strip((static_cast<double>(i) + 0.5) / count, values[i], scale));
    }
    const double width = floor_right() - floor_left();
    for (double x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(x / width * count);
      canvas_.rectangle({floor_left() + x, points[i].y}, {floor_left() + x + 1, strip_bottom()},
                        {panel_.color, 0.25});
    }
    canvas_.polyline(points, 2, {panel_.color});
  }

  void dashes(std::span<const double> values, const Scale& scale) {
    const std::size_t dash = std::max<std::size_t>(1, values.size() / 64);
    const auto at = [&](std::size_t i) {
      return on_strip((static_cast<double>(i) + 0.5) / static_cast<double>(values.size()),
                      values[i], scale);
    };
    for (std::size_t i = 0; i + dash < values.size(); i += 2 * dash) {
      canvas_.line(at(i), at(i + dash), 1.5, {kGray});
    }
    const Point2 end = at(values.size() - 1);
    canvas_.text({end.x + 8, end.y + 0.5 * kSmallLetters}, "uniform", kSmallLetters, {kGray});
  }

  Canvas& canvas_;
  const GapScene& scene_;
  const Panel& panel_;
  double left_, top_;
};

}  // namespace

Image draw_picture(const GapScene& scene, std::span<const Panel> panels,
                   std::span<const double> uniform, double full_value) {
  const double panel_width = 2 * seen_half_width(scene) * kUnit + 2 * kMargin;
  const double height = kTitleHeight + scene.light_height * kUnit + kFloorSpace + kStripHeight;
  Canvas canvas(static_cast<int>(panel_width * static_cast<double>(panels.size())),
                static_cast<int>(height + kMargin), kPaper);
  const Scale scale = scale_of(panels, uniform);
  double left = kMargin;
  for (const Panel& panel : panels) {
    PanelDrawing drawing(canvas, scene, panel, left, kTitleHeight);
    drawing.draw_scene(full_value);
    drawing.draw_strip(scale, uniform);
    left += panel_width;
  }
  return canvas.image();
}

}  // namespace pharos::focal::plane

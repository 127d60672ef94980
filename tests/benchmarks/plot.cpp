#include "plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include <pharos/core/error.h>

namespace pharos::bench {
namespace {

constexpr double kLeft = 64, kRight = 400, kTop = 36, kBottom = 220;
constexpr std::array kColors{"#1f5fa8", "#c4501b", "#2a8a4a", "#8a4fa3",
                             "#8c6d1f", "#d0407f", "#222222", "#2aa3b5"};

/// A logarithmic axis from `low` to `high`, drawn from pixel `from` to pixel `to`.
class Axis {
 public:
  Axis(double low, double high, double from, double to)
      : low_(std::log10(low)), scale_((to - from) / (std::log10(high) - low_)), from_(from) {}
  double at(double value) const { return from_ + scale_ * (std::log10(value) - low_); }

 private:
  double low_, scale_, from_;
};

/// Returns 1, 2 or 5 times a power of ten: the largest that is at most `value`, or the smallest
/// that is at least `value`.
double round_number(double value, bool up) {
  const double power = std::pow(10, std::floor(std::log10(value) + 1e-9));
  const std::array<double, 4> steps{1, 2, 5, 10};
  const auto fits = [&](double s) {
    return up ? s * power >= 0.999 * value : s * power > 1.001 * value;
  };
  const auto found = std::find_if(steps.begin(), steps.end(), fits);
  return power * (up ? *found : *(found - 1));
}

/// Returns a number with all digits before the point, or with two digits if it is large or small.
std::string short_number(double value) {
  return value >= 1 && value < 1e5 ? fmt::format("{:.0f}", value) : fmt::format("{:.2g}", value);
}

std::string text(double x, double y, const char* anchor, const std::string& content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     content);
}
std::string line(double x1, double y1, double x2, double y2, const char* color) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2,
      y2, color);
}

/// The grid lines from below the least value to above the largest one: 1, 2 and 5 times each power
/// of ten, or the powers alone if there are many.
struct Ticks {
  double low, high;
  bool powers;

  Ticks(double least, double most) : powers(most > 300 * least) {
    low = powers ? std::pow(10, std::floor(std::log10(least))) : round_number(least, false);
    high = powers ? std::pow(10, std::ceil(std::log10(most) - 1e-9)) : round_number(most, true);
    high = std::max(high, 2 * low);
  }
  double after(double tick) const { return powers ? 10 * tick : round_number(1.5 * tick, true); }
};

/// Draws a curve. If there are several, its name follows in the legend at the right.
std::string curve_svg(const Curve& curve, std::size_t number, bool has_name, const Axis& x,
                      const Axis& y) {
  const char* const color = kColors[number % kColors.size()];
  std::string svg, way;
  for (const Point& p : curve.points) {
    way += fmt::format("{:.1f},{:.1f} ", x.at(p.x), y.at(p.y));
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", x.at(p.x),
                       y.at(p.y), color);
  }
  svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", way, color);
  if (!has_name) return svg;
  const double height = kTop + 16 * static_cast<double>(number);
  return svg + line(kRight + 16, height, kRight + 32, height, color) +
         text(kRight + 38, height + 4, "start", curve.name);
}

std::vector<Point> all_points(const Plot& plot) {
  std::vector<Point> all;
  for (const Curve& curve : plot.curves) {
    all.insert(all.end(), curve.points.begin(), curve.points.end());
  }
  return all;
}

std::string svg_of(const Plot& plot) {
  const std::vector<Point> points = all_points(plot);
  const auto [x0, x1] = std::ranges::minmax(points, {}, &Point::x);
  const auto [y0, y1] = std::ranges::minmax(points, {}, &Point::y);
  const Ticks ticks(plot.least > 0 ? plot.least : y0.y, y1.y);
  const Axis x(x0.x, x1.x, kLeft, kRight), y(ticks.low, ticks.high, kBottom, kTop);
  const bool has_names = plot.curves.size() > 1;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} 270\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n",
      has_names ? 620 : 430);
  svg += text(kLeft, 22, "start", plot.title);
  for (double tick = ticks.low; tick < 1.01 * ticks.high; tick = ticks.after(tick)) {
    svg += line(kLeft, y.at(tick), kRight, y.at(tick), "#ddd");
    svg += text(kLeft - 6, y.at(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  for (const Point& p : plot.curves.front().points) {
    svg += line(x.at(p.x), kBottom, x.at(p.x), kBottom + 4, "#444");
    svg += text(x.at(p.x), kBottom + 18, "middle", short_number(p.x));
  }
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    svg += curve_svg(plot.curves[i], i, has_names, x, y);
  }
  svg += text((kLeft + kRight) / 2, kBottom + 40, "middle", plot.x_name);
  return svg + "</svg>\n";
}

}  // namespace

void write_plot(const std::filesystem::path& file, const Plot& plot) {
  std::ofstream out(file);
  out << svg_of(plot);
  if (!out.flush()) throw RunError(file.string() + ": cannot be written");
}

}  // namespace pharos::bench

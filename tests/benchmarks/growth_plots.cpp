#include "growth_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <string>

#include <fmt/format.h>

#include <pharos/core/error.h>

namespace pharos::bench {
namespace {

struct Point {
  double x, y;
};

/// The points of one plot, in the order in which they were measured.
struct Curve {
  std::string parameter, figure, unit;
  std::vector<Point> points;
};

/// Splits growth.PARAMETER.VALUE.FIGURE. Returns empty strings for other names.
std::array<std::string, 3> parts_of(const std::string& name) {
  constexpr std::string_view kPrefix = "growth.";
  if (!name.starts_with(kPrefix)) return {};
  const std::size_t first = kPrefix.size(), second = name.find('.', first), last = name.rfind('.');
  if (second == std::string::npos || last <= second) return {};
  return {name.substr(first, second - first), name.substr(second + 1, last - second - 1),
          name.substr(last + 1)};
}

std::vector<Curve> curves_of(const std::vector<Measurement>& all) {
  std::map<std::string, Curve> curves;
  for (const Measurement& m : all) {
    const auto [parameter, value, figure] = parts_of(m.name);
    if (parameter.empty() || !(m.median() > 0)) continue;
    Curve& curve = curves[parameter + "-" + figure];
    curve.parameter = parameter, curve.figure = figure, curve.unit = m.unit;
    curve.points.push_back({std::stod(value), m.median()});
  }
  std::vector<Curve> result;
  for (auto& [name, curve] : curves) result.push_back(std::move(curve));
  return result;
}

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

std::string svg_of(const Curve& curve) {
  constexpr double kLeft = 64, kRight = 400, kTop = 36, kBottom = 220;
  const auto [x0, x1] = std::ranges::minmax(curve.points, {}, &Point::x);
  const auto [y0, y1] = std::ranges::minmax(curve.points, {}, &Point::y);
  const double low = round_number(y0.y, false);
  const double high = std::max(round_number(y1.y, true), 2 * low);
  const Axis x(x0.x, x1.x, kLeft, kRight), y(low, high, kBottom, kTop);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 430 270\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n";
  svg += text(kLeft, 22, "start", fmt::format("{} [{}]", curve.figure, curve.unit));
  for (double tick = low; tick < 1.01 * high; tick = round_number(1.5 * tick, true)) {
    svg += line(kLeft, y.at(tick), kRight, y.at(tick), "#ddd");
    svg += text(kLeft - 6, y.at(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  std::string way;
  for (const Point& p : curve.points) {
    way += fmt::format("{:.1f},{:.1f} ", x.at(p.x), y.at(p.y));
    svg += line(x.at(p.x), kBottom, x.at(p.x), kBottom + 4, "#444");
    svg += text(x.at(p.x), kBottom + 18, "middle", short_number(p.x));
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#1f5fa8\"/>\n",
                       x.at(p.x), y.at(p.y));
  }
  svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#1f5fa8\"/>\n", way);
  svg += text((kLeft + kRight) / 2, kBottom + 40, "middle", curve.parameter);
  return svg + "</svg>\n";
}

}  // namespace

void write_growth_plots(const std::filesystem::path& folder, const std::vector<Measurement>& all) {
  for (const Curve& curve : curves_of(all)) {
    if (curve.points.size() < 2) continue;
    const std::filesystem::path file =
        folder / fmt::format("growth-{}-{}.svg", curve.parameter, curve.figure);
    std::ofstream out(file);
    out << svg_of(curve);
    if (!out.flush()) throw RunError(file.string() + ": cannot be written");
  }
}

}  // namespace pharos::bench

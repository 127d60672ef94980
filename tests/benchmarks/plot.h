#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pharos::bench {

struct Point {
  double x, y;
};
struct Curve {
  std::string name;
  std::vector<Point> points;
};

/// Curves over logarithmic axes. All values are positive. The first curve has all values of x.
struct Plot {
  std::string title, x_name;
  std::vector<Curve> curves;
  double least = 0;  ///< where the axis of the values begins; 0: at the least value
};

/// Draws a plot as an SVG file. Throws RunError if the file cannot be written.
void write_plot(const std::filesystem::path& file, const Plot& plot);

}  // namespace pharos::bench

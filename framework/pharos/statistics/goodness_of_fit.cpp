#include <algorithm>
#include <bitset>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/special_functions/gamma.hpp>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>

namespace pharos::statistics {
namespace {

struct Point {
  double x = 0, y = 0;
};

/// A cell with its pilot draws and its number of tested draws.
struct Cell {
  Rectangle area;
  std::span<Point> pilot;
  double observed = 0;
};

/// Returns the area-preserving coordinates of a direction in kSphereRectangle.
Point sphere_point(Vec3 d) {
  const double x = d.x, y = d.y, z = d.z;
  const double sine_squared = (x * x + y * y) / (x * x + y * y + z * z);
  const double cosine = std::sqrt(1 - sine_squared);
  const double near_pole = sine_squared / (1 + cosine);
  const double phi = std::atan2(y, x);
  return {z >= 0 ? near_pole : 2 - near_pole, phi < 0 ? phi + kSphereRectangle.y1 : phi};
}

/// A measure of how evenly draws fill a cell: the number of occupied bins of a raster, divided by
/// the expected number for as many evenly spread draws. About 1 for even draws, small for crowded
/// ones.
struct Filling {
  double area = 1;      ///< for a square raster
  double x = 1, y = 1;  ///< for its columns and rows
};

Filling filling(const Rectangle& area, std::span<const Point> draws) {
  constexpr int kBins = 8;
  std::bitset<kBins> columns, rows;
  std::bitset<kBins * kBins> raster;
  const auto bin = [](double low, double high, double at) {
    const double relative = (at - low) / (high - low);
    return static_cast<std::size_t>(std::clamp(static_cast<int>(kBins * relative), 0, kBins - 1));
  };
  for (const Point& p : draws) {
    const std::size_t column = bin(area.x0, area.x1, p.x), row = bin(area.y0, area.y1, p.y);
    columns.set(column);
    rows.set(row);
    raster.set(row * kBins + column);
  }
  const auto share = [&](std::size_t held, double bins) {
    const double expected = bins * (1 - std::pow(1 - 1 / bins, static_cast<double>(draws.size())));
    return static_cast<double>(held) / expected;
  };
  return {share(raster.count(), kBins * kBins), share(columns.count(), kBins),
          share(rows.count(), kBins)};
}

/// Bisects `area` until each cell holds at most `max_pilot` pilot draws and these fill it roughly.
/// If the draws crowd in parts of a cell, quadrature could miss these parts.
void bisect(const Rectangle& area, std::span<Point> pilot, std::span<Point> tested,
            std::size_t max_pilot, int depth, std::vector<Cell>& cells) {
  constexpr double kCrowded = 0.5;
  constexpr int kMaxDepth = 80;  // resolves both coordinates to float precision
  const Filling filled = pilot.size() < 2 ? Filling{} : filling(area, pilot);
  if (depth == kMaxDepth || (pilot.size() <= max_pilot && filled.area >= kCrowded)) {
    cells.push_back({area, pilot, static_cast<double>(tested.size())});
    return;
  }
  constexpr double kAlike = 0.1;
  const bool alike = std::abs(filled.x - filled.y) < kAlike;
  const bool along_x = alike ? depth % 2 == 0 : filled.x < filled.y;
  const auto [low, high] = bisected(area, along_x);
  const double middle = along_x ? high.x0 : high.y0;
  const auto cut = [&](std::span<Point> points) {
    const auto at = std::partition(points.begin(), points.end(),
                                   [&](Point p) { return (along_x ? p.x : p.y) < middle; });
    return static_cast<std::size_t>(at - points.begin());
  };
  const std::size_t a = cut(pilot), b = cut(tested);
  bisect(low, pilot.first(a), tested.first(b), max_pilot, depth + 1, cells);
  bisect(high, pilot.subspan(a), tested.subspan(b), max_pilot, depth + 1, cells);
}

/// Integrates the density over each cell, in patches that follow the cell's pilot draws.
template <class F>
std::vector<Integral> integrate_density(const F& density, std::span<const Cell> cells,
                                        double tolerance) {
  constexpr std::size_t kPatchDraws = 64;
  std::vector<Cell> patches;
  std::vector<Rectangle> areas;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    patches.clear();
    bisect(cells[i].area, cells[i].pilot, {}, kPatchDraws, 0, patches);
    for (const Cell& patch : patches) {
      areas.push_back(patch.area);
      owners.push_back(i);
    }
  }
  const std::vector<Integral> parts = integrate_cells(density, areas, {.tolerance = tolerance});
  std::vector<Integral> sums(cells.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sums[owners[i]].value += parts[i].value;
    sums[owners[i]].error += parts[i].error;
  }
  return sums;
}

ChiSquareResult test_counts(std::span<const Cell> cells, std::span<const Integral> integrals,
                            double missed, double draws, DensityFit& fit) {
  std::vector<double> observed, expected;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    observed.push_back(cells[i].observed);
    expected.push_back(draws * integrals[i].value);
    fit.integral += integrals[i].value;
    fit.integral_error += integrals[i].error;
  }
  // A loss within the quadrature error must not count as expected misses.
  const double loss = 1 - fit.integral;
  observed.push_back(missed);
  expected.push_back(loss > fit.integral_error ? draws * loss : 0);
  // Cells at the edge of a lobe expect few draws. With a minimum of five, the tail of the test
  // would be too heavy for the small significance levels of whole suites.
  constexpr double kMinExpected = 25;
  return chi_square_test(observed, expected, kMinExpected);
}

/// The part of the test that all domains share. `to_point` maps results to `domain`, and
/// `density_at(x, y)` evaluates the density there.
template <class T, class ToPoint, class DensityAt>
DensityFit fit_density(const Draw<T>& draw, const Density<T>& density, const FitOptions& options,
                       const Rectangle& domain, const ToPoint& to_point,
                       const DensityAt& density_at) {
  DensityFit fit;
  RandomStream random(options.seed);
  const std::size_t half = options.draws / 2;
  std::vector<Point> pilot, tested;
  for (std::size_t i = 0; i < half; ++i) {
    if (const auto result = draw(random)) pilot.push_back(to_point(*result));
  }
  for (std::size_t i = 0; i < half; ++i) {
    const auto result = draw(random);
    if (!result) continue;
    tested.push_back(to_point(*result));
    const double value = density(*result);
    if (!(value > 0 && std::isfinite(value))) ++fit.outside_support;
  }
  std::vector<Cell> cells;
  bisect(domain, pilot, tested, half / static_cast<std::size_t>(options.cells), 0, cells);
  // Invalid values are counted separately, because a single infinity or NaN would hide everything
  // else.
  const auto valid_density = [&](double x, double y) {
    const double value = density_at(x, y);
    if (value >= 0 && std::isfinite(value)) return value;
    ++fit.invalid_nodes;
    return 0.0;
  };
  const auto integrals = integrate_density(valid_density, cells, options.quadrature_tolerance);
  const double n = static_cast<double>(half), missed = n - static_cast<double>(tested.size());
  fit.missed = missed / n;
  fit.chi_square = test_counts(cells, integrals, missed, n, fit);
  return fit;
}

}  // namespace

ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected,
                                double min_expected) {
  std::vector<std::size_t> order(observed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  double pooled_observed = 0, pooled_expected = 0;
  ChiSquareResult result;
  int cells = 0;
  const auto close_cell = [&] {
    const double difference = pooled_observed - pooled_expected;
    result.statistic += difference * difference / pooled_expected;
    pooled_observed = pooled_expected = 0;
    ++cells;
  };
  for (std::size_t k = 0; k < order.size(); ++k) {
    pooled_observed += observed[order[k]];
    pooled_expected += expected[order[k]];
    const bool next_is_small = k + 1 < order.size() && expected[order[k + 1]] < min_expected;
    if (pooled_expected >= min_expected && !next_is_small) close_cell();
  }
  result.degrees_of_freedom = std::max(0, cells - 1);
  if (result.degrees_of_freedom > 0) {
    result.p_value = boost::math::gamma_q(0.5 * result.degrees_of_freedom, 0.5 * result.statistic);
  }
  return result;
}

DensityFit fit_direction_density(const Draw<Vec3>& draw, const Density<Vec3>& density,
                                 const FitOptions& options) {
  const auto density_at = [&](double x, double y) { return density(direction_at(x, y)); };
  return fit_density(draw, density, options, kSphereRectangle, sphere_point, density_at);
}

DensityFit fit_square_density(const Draw<Vec2>& draw, const Density<Vec2>& density,
                              const FitOptions& options) {
  const auto to_point = [](Vec2 v) { return Point{v.x, v.y}; };
  const auto density_at = [&](double x, double y) {
    return density(Vec2{static_cast<float>(x), static_cast<float>(y)});
  };
  return fit_density(draw, density, options, Rectangle{}, to_point, density_at);
}

}  // namespace pharos::statistics

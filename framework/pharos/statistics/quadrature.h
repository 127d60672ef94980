#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

/// Deterministic integration over rectangles and over the sphere, for tests of densities.
namespace pharos::statistics {

/// An axis-aligned rectangle of integration variables.
struct Rectangle {
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
};

/// Returns both halves of a rectangle, the lower one first.
inline std::array<Rectangle, 2> bisected(const Rectangle& r, bool along_x) {
  Rectangle low = r, high = r;
  (along_x ? low.x1 : low.y1) = along_x ? 0.5 * (r.x0 + r.x1) : 0.5 * (r.y0 + r.y1);
  (along_x ? high.x0 : high.y0) = along_x ? low.x1 : low.y1;
  return {low, high};
}

/// A computed integral with an estimate of its error, both in the unit of the integral. The
/// estimate is too large for smooth integrands and realistic along discontinuities.
struct Integral {
  double value = 0;
  double error = 0;
};

struct QuadratureOptions {
  double tolerance = 1e-5;  ///< bound on the sum of all errors [unit of the integral]
  std::size_t max_evaluations = 2'000'000;  ///< integration then stops, whatever its error
};

/// The rectangle that parametrizes the sphere and preserves area: x = 1 - cos(theta) in [0, 2], y =
/// phi in [0, 2 pi). A density in these variables is a density per steradian.
inline constexpr Rectangle kSphereRectangle{0, 2, 0, 2 * 3.14159265358979323846};

/// Returns the direction at (1 - cos(theta), phi). Directions near the poles keep all their digits.
inline Vec3 direction_at(double one_minus_cos, double phi) {
  const double sine = std::sqrt(std::max(0.0, one_minus_cos * (2 - one_minus_cos)));
  return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
          static_cast<float>(1 - one_minus_cos)};
}

namespace detail {

struct GaussNode {
  double position, weight;  // on [-1, 1]; the weights add up to 1 and give a mean
};
inline constexpr std::array<GaussNode, 3> kGauss3{
    {{-0.7745966692414834, 5.0 / 18}, {0, 4.0 / 9}, {0.7745966692414834, 5.0 / 18}}};
inline constexpr std::array<GaussNode, 5> kGauss5{{{-0.9061798459386640, 0.1184634425280945},
                                                   {-0.5384693101056831, 0.2393143352496832},
                                                   {0, 0.2844444444444444},
                                                   {0.5384693101056831, 0.2393143352496832},
                                                   {0.9061798459386640, 0.1184634425280945}}};

template <std::size_t N>
using GaussGrid = std::array<std::array<double, N>, N>;

/// Returns the values of f at the nodes of the rule. The first index runs along x.
template <class F, std::size_t N>
GaussGrid<N> sample_nodes(const F& f, const Rectangle& r, const std::array<GaussNode, N>& nodes) {
  const double cx = 0.5 * (r.x0 + r.x1), hx = 0.5 * (r.x1 - r.x0);
  const double cy = 0.5 * (r.y0 + r.y1), hy = 0.5 * (r.y1 - r.y0);
  GaussGrid<N> values;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      values[i][j] = f(cx + hx * nodes[i].position, cy + hy * nodes[j].position);
    }
  }
  return values;
}

template <std::size_t N>
double mean_of(const GaussGrid<N>& values, const std::array<GaussNode, N>& nodes) {
  double mean = 0;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) mean += nodes[i].weight * nodes[j].weight * values[i][j];
  }
  return mean;
}

/// Mean sizes of the fourth differences along x and along y. They vanish quickly where the
/// integrand is smooth, and stay as large as the jump along a discontinuity.
struct Roughness {
  double along_x = 0, along_y = 0;
};

inline Roughness roughness(const GaussGrid<5>& v) {
  const auto fourth = [](double a, double b, double c, double d, double e) {
    return std::abs(a - 4 * b + 6 * c - 4 * d + e);
  };
  Roughness sum;
  for (std::size_t k = 0; k < 5; ++k) {
    sum.along_x += fourth(v[0][k], v[1][k], v[2][k], v[3][k], v[4][k]) / 5;
    sum.along_y += fourth(v[k][0], v[k][1], v[k][2], v[k][3], v[k][4]) / 5;
  }
  return sum;
}

struct Patch {
  Rectangle area;
  std::size_t cell;
  Integral integral;
  bool split_x;
  friend bool operator<(const Patch& a, const Patch& b) {
    return a.integral.error < b.integral.error;
  }
};
inline constexpr std::size_t kPatchEvaluations = 9 + 25;

template <class F>
Patch integrate_patch(const F& f, const Rectangle& r, std::size_t cell) {
  const GaussGrid<5> values = sample_nodes(f, r, kGauss5);
  const double fine = mean_of(values, kGauss5);
  const double coarse = mean_of(sample_nodes(f, r, kGauss3), kGauss3);
  const double area = (r.x1 - r.x0) * (r.y1 - r.y0);
  // Both rules may agree by accident along a discontinuity. A jump across the patch has fourth
  // differences of about three times its height and changes the integral by a tenth of its height.
  constexpr double kJump = 0.03;
  const Roughness rough = roughness(values);
  const double jump = kJump * std::max(rough.along_x, rough.along_y);
  return {r,
          cell,
          {area * fine, area * std::max(std::abs(fine - coarse), jump)},
          rough.along_x > rough.along_y};
}

}  // namespace detail

/// Integrates f(x, y) over each of `cells` by tensor Gauss rules of three and five points.
/// Repeatedly bisects the worst patch of all cells, along the axis of larger fourth differences,
/// until the errors add up to less than the tolerance or the evaluations are used up. A peak that
/// falls between all nodes of a cell is missed, so callers that know the peaks should pass cells of
/// their size.
template <class F>
std::vector<Integral> integrate_cells(const F& f, std::span<const Rectangle> cells,
                                      const QuadratureOptions& options = {}) {
  std::vector<Integral> sums(cells.size());
  std::priority_queue<detail::Patch> worst_first;
  double total_error = 0;
  std::size_t evaluations = 0;
  const auto count = [&](const detail::Patch& patch, double sign) {
    sums[patch.cell].value += sign * patch.integral.value;
    sums[patch.cell].error += sign * patch.integral.error;
    total_error += sign * patch.integral.error;
  };
  const auto add = [&](const Rectangle& area, std::size_t cell) {
    const detail::Patch patch = detail::integrate_patch(f, area, cell);
    count(patch, 1);
    worst_first.push(patch);
    evaluations += detail::kPatchEvaluations;
  };
  for (std::size_t i = 0; i < cells.size(); ++i) add(cells[i], i);
  while (total_error > options.tolerance && evaluations < options.max_evaluations) {
    const detail::Patch worst = worst_first.top();
    worst_first.pop();
    count(worst, -1);
    for (const Rectangle& half : bisected(worst.area, worst.split_x)) add(half, worst.cell);
  }
  return sums;
}

/// Integrates f(x, y) over one rectangle.
template <class F>
Integral integrate(const F& f, const Rectangle& area, const QuadratureOptions& options = {}) {
  return integrate_cells(f, std::span(&area, 1), options).front();
}

/// Integrates f(direction) over the sphere [unit of f times sr], starting from `rows` x `columns`
/// cells of equal solid angle.
template <class F>
Integral integrate_sphere(const F& f, const QuadratureOptions& options = {}, int rows = 16,
                          int columns = 16) {
  const Rectangle& all = kSphereRectangle;
  std::vector<Rectangle> cells;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      cells.push_back({all.x1 * i / rows, all.x1 * (i + 1) / rows, all.y1 * j / columns,
                       all.y1 * (j + 1) / columns});
    }
  }
  Integral sum;
  const auto at = [&](double x, double y) { return f(direction_at(x, y)); };
  for (const Integral& cell : integrate_cells(at, cells, options)) {
    sum.value += cell.value;
    sum.error += cell.error;
  }
  return sum;
}

}  // namespace pharos::statistics

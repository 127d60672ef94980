#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/statistics/point_sets.h>

namespace pharos::statistics {
namespace {

void check_points(std::span<const Vec2> points) {
  if (points.empty()) throw InputError("expected at least one point, found none");
  for (const Vec2 p : points) {
    if (p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) continue;
    throw InputError(fmt::format("expected points in [0, 1)^2, found ({}, {})", p.x, p.y));
  }
}

/// Returns the index of the cell of u in [0,1) among 2^bits equal cells.
std::size_t cell_of(float u, int bits) {
  return static_cast<std::size_t>(std::ldexp(u, bits));
}

/// Returns whether all of the 2^a by 2^b cells hold the same number of points.
bool fills_evenly(std::span<const Vec2> points, int a, int b, std::vector<std::uint32_t>& counts) {
  const std::size_t share = points.size() >> (a + b);
  counts.assign(std::size_t{1} << (a + b), 0);
  for (const Vec2 p : points) {
    if (++counts[(cell_of(p.y, b) << a) + cell_of(p.x, a)] > share) return false;
  }
  return true;
}

/// The number of points whose waves are multiplied at once. They are few enough to stay in the
/// cache.
constexpr std::size_t kBlock = 64;

/// The cosines and sines of 2 pi f u. Rows are the u of a block of points, columns are the
/// frequencies f from 0 to the largest.
struct Waves {
  std::size_t columns;
  std::vector<double> cosines, sines;

  explicit Waves(int max_frequency)
      : columns(static_cast<std::size_t>(max_frequency) + 1),
        cosines(kBlock * columns),
        sines(kBlock * columns) {}

  /// Computes the waves of each frequency as the product of the previous and the first waves.
  void fill(std::span<const Vec2> points, float Vec2::*component) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double angle = 2 * std::numbers::pi * points[i].*component;
      const double c = std::cos(angle), s = std::sin(angle);
      double* cosine = &cosines[i * columns];
      double* sine = &sines[i * columns];
      cosine[0] = 1, sine[0] = 0;
      for (std::size_t f = 1; f < columns; ++f) {
        cosine[f] = cosine[f - 1] * c - sine[f - 1] * s;
        sine[f] = sine[f - 1] * c + cosine[f - 1] * s;
      }
    }
  }
};

/// Sums over points of the products of the waves of x (rows: frequencies) and y (columns:
/// frequencies).
struct Products {
  std::size_t edge;
  std::vector<double> cos_cos, sin_sin, cos_sin, sin_cos;

  explicit Products(int max_frequency) : edge(static_cast<std::size_t>(max_frequency) + 1) {
    for (std::vector<double>* all : {&cos_cos, &sin_sin, &cos_sin, &sin_cos}) {
      all->resize(edge * edge);
    }
  }
  void add(const Waves& x, const Waves& y, std::size_t points) {
    for (std::size_t row = 0; row < edge; ++row) {
      double *cc = &cos_cos[row * edge], *ss = &sin_sin[row * edge];
      double *cs = &cos_sin[row * edge], *sc = &sin_cos[row * edge];
      for (std::size_t i = 0; i < points; ++i) {
        const double c = x.cosines[i * edge + row], s = x.sines[i * edge + row];
        const double *cosine = &y.cosines[i * edge], *sine = &y.sines[i * edge];
        for (std::size_t f = 0; f < edge; ++f) cc[f] += c * cosine[f];
        for (std::size_t f = 0; f < edge; ++f) ss[f] += s * sine[f];
        for (std::size_t f = 0; f < edge; ++f) cs[f] += c * sine[f];
        for (std::size_t f = 0; f < edge; ++f) sc[f] += s * cosine[f];
      }
    }
  }
  /// Returns the squared modulus of the sum of exp(-2 pi i (x, y).p) for x >= 0, by the angle sum
  /// formulas.
  double power(int x, int y) const {
    const std::size_t place =
        static_cast<std::size_t>(x) * edge + static_cast<std::size_t>(std::abs(y));
    const double sign = y < 0 ? -1 : 1;
    const double real = cos_cos[place] - sign * sin_sin[place];
    const double imaginary = sign * cos_sin[place] + sin_cos[place];
    return real * real + imaginary * imaginary;
  }
};

}  // namespace

double star_discrepancy(std::span<const Vec2> points) {
  check_points(points);
  std::vector<Vec2> by_x(points.begin(), points.end());
  std::ranges::sort(by_x, {}, &Vec2::x);
  const double share = 1.0 / static_cast<double>(points.size());
  // The sorted y coordinates of the points taken so far, between 0 and 1.
  std::vector<double> heights{0, 1};
  double largest = 0;
  for (std::size_t taken = 0; taken <= by_x.size(); ++taken) {
    const double left = taken == 0 ? 0 : by_x[taken - 1].x;
    const double right = taken == by_x.size() ? 1 : by_x[taken].x;
    if (taken > 0) {
      const double y = by_x[taken - 1].y;
      heights.insert(std::upper_bound(heights.begin(), heights.end() - 1, y), y);
    }
    for (std::size_t below = 0; below <= taken; ++below) {
      const double inside = share * static_cast<double>(below);
      largest = std::max({largest, std::abs(inside - left * heights[below]),
                          std::abs(inside - right * heights[below + 1])});
    }
  }
  return largest;
}

int net_quality(std::span<const Vec2> points) {
  check_points(points);
  if (!std::has_single_bit(points.size())) {
    throw InputError(
        fmt::format("expected a power of two of points for a net, found {}", points.size()));
  }
  const int m = std::countr_zero(points.size());
  std::vector<std::uint32_t> counts;
  const auto is_net = [&](int t) {
    for (int a = 0; a <= m - t; ++a) {
      if (!fills_evenly(points, a, m - t - a, counts)) return false;
    }
    return true;
  };
  int t = 0;
  while (!is_net(t)) ++t;
  return t;
}

bool fills_elementary_intervals(std::span<const Vec2> points) {
  return net_quality(points) == 0;
}

PowerSpectrum::PowerSpectrum(int max_frequency) : max_frequency_(max_frequency) {
  if (max_frequency < 1) {
    throw InputError(fmt::format("expected a positive frequency, found {}", max_frequency));
  }
  const auto edge = static_cast<std::size_t>(max_frequency) + 1;
  sums_.resize(edge * (2 * edge - 1));
}

void PowerSpectrum::add(std::span<const Vec2> points) {
  check_points(points);
  Waves x(max_frequency_), y(max_frequency_);
  Products products(max_frequency_);
  for (std::size_t start = 0; start < points.size(); start += kBlock) {
    const auto block = points.subspan(start, std::min(kBlock, points.size() - start));
    x.fill(block, &Vec2::x);
    y.fill(block, &Vec2::y);
    products.add(x, y, block.size());
  }
  const double share = 1.0 / static_cast<double>(points.size());
  std::size_t place = 0;
  for (int fx = 0; fx <= max_frequency_; ++fx) {
    for (int fy = -max_frequency_; fy <= max_frequency_; ++fy) {
      sums_[place++] += share * products.power(fx, fy);
    }
  }
  ++count_;
}

double PowerSpectrum::at(int x, int y) const {
  if (std::max(std::abs(x), std::abs(y)) > max_frequency_) {
    throw InputError(fmt::format("expected a frequency from -{0} to {0}, found ({1}, {2})",
                                 max_frequency_, x, y));
  }
  if ((x == 0 && y == 0) || count_ == 0) return 0;
  if (x < 0) return at(-x, -y);
  const int column = y + max_frequency_;
  const auto place = static_cast<std::size_t>(x * (2 * max_frequency_ + 1) + column);
  return sums_[place] / static_cast<double>(count_);
}

std::vector<double> PowerSpectrum::ring_means() const {
  std::vector<double> means(static_cast<std::size_t>(max_frequency_) + 1);
  std::vector<std::size_t> counts(means.size());
  for (int x = -max_frequency_; x <= max_frequency_; ++x) {
    for (int y = -max_frequency_; y <= max_frequency_; ++y) {
      const auto ring = static_cast<std::size_t>(std::lround(std::hypot(x, y)));
      if (ring >= means.size()) continue;
      means[ring] += at(x, y);
      ++counts[ring];
    }
  }
  for (std::size_t ring = 0; ring < means.size(); ++ring) {
    means[ring] /= static_cast<double>(counts[ring]);
  }
  return means;
}

}  // namespace pharos::statistics

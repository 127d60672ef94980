#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/statistics/intervals.h>
#include <pharos/statistics/point_sets.h>

namespace pharos::statistics {
namespace {

using Points = std::vector<Vec2>;

Points independent(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  Points points(count);
  for (Vec2& p : points) p = random.next_2d();
  return points;
}

/// Returns 2^bits by 2^bits points, each at `offset` [1] within its cell.
Points grid(int bits, float offset) {
  Points points;
  const int edge = 1 << bits;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      points.push_back((1.0f / static_cast<float>(edge)) *
                       Vec2{static_cast<float>(x) + offset, static_cast<float>(y) + offset});
    }
  }
  return points;
}

/// Returns the radical inverse of `i` in base 2.
float radical_inverse(std::uint32_t i) {
  float value = 0, digit = 0.5f;
  for (; i > 0; i >>= 1, digit /= 2) value += (i & 1) != 0 ? digit : 0;
  return value;
}

Points hammersley(std::uint32_t count) {
  Points points;
  for (std::uint32_t i = 0; i < count; ++i) {
    points.push_back({static_cast<float>(i) / static_cast<float>(count), radical_inverse(i)});
  }
  return points;
}

/// Returns the first two dimensions of the Sobol sequence. The second dimension uses the direction
/// numbers v_(j+1) = v_j xor (v_j >> 1).
Points sobol(std::uint32_t count) {
  Points points;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t y = 0, direction = 0x80000000u;
    for (std::uint32_t rest = i; rest > 0; rest >>= 1, direction ^= direction >> 1) {
      if ((rest & 1) != 0) y ^= direction;
    }
    points.push_back({radical_inverse(i), to_unit_float(y)});
  }
  return points;
}

/// Computes the star discrepancy by its definition, from all boxes whose sides end at a point or at
/// 1, with and without their upper edges.
double star_discrepancy_by_definition(const Points& points) {
  std::vector<double> xs{1}, ys{1};
  for (const Vec2 p : points) {
    xs.push_back(p.x);
    ys.push_back(p.y);
  }
  double largest = 0;
  for (const double a : xs) {
    for (const double b : ys) {
      const auto open = std::ranges::count_if(points, [&](Vec2 p) { return p.x < a && p.y < b; });
      const auto closed =
          std::ranges::count_if(points, [&](Vec2 p) { return p.x <= a && p.y <= b; });
      const auto n = static_cast<double>(points.size());
      largest = std::max({largest, a * b - static_cast<double>(open) / n,
                          static_cast<double>(closed) / n - a * b});
    }
  }
  return largest;
}

double power_by_definition(const Points& points, int x, int y) {
  std::complex<double> sum = 0;
  for (const Vec2 p : points) {
    sum += std::polar(1.0, -2 * std::numbers::pi * (double{p.x} * x + double{p.y} * y));
  }
  return std::norm(sum) / static_cast<double>(points.size());
}

double sinc_squared(double v) {
  if (v == 0) return 1;
  const double angle = std::numbers::pi * v;
  return std::pow(std::sin(angle) / angle, 2);
}

}  // namespace

TEST_CASE("star discrepancy: one point") {
  // The box up to the point is empty and has the area x y. The box that just holds the point is too
  // small by 1 - x y. The slabs beside the point are empty and have areas of up to max(x, y).
  CHECK(star_discrepancy(Points{{0.5f, 0.5f}}) == doctest::Approx(0.75));
  CHECK(star_discrepancy(Points{{0.75f, 0.875f}}) == doctest::Approx(0.875));
  CHECK(star_discrepancy(Points{{0, 0}}) == doctest::Approx(1));
}

TEST_CASE("star discrepancy: a grid's is known") {
  // For m x m points at the corners of their cells, the closed box up to the last point holds all
  // points and has the area (1 - 1/m)^2. For points at the centers, its area is (1 - 1/(2 m))^2.
  for (const int bits : {1, 2, 4}) {
    const double edge = 1 << bits;
    CHECK(star_discrepancy(grid(bits, 0)) == doctest::Approx(1 - std::pow(1 - 1 / edge, 2)));
    CHECK(star_discrepancy(grid(bits, 0.5f)) == doctest::Approx(1 - std::pow(1 - 0.5 / edge, 2)));
  }
}

TEST_CASE("star discrepancy: Hammersley's points have the published value") {
  // Theorem of Halton and Zaremba (1969): 2^m points with m >= 2 have D* = (m / 3 + 13 / 9 - (-1)^m
  // 4 / 9 / 2^m) / 2^m.
  for (const int m : {2, 3, 5, 8}) {
    const double n = std::exp2(m);
    const double expected = (m / 3.0 + 13.0 / 9 - (m % 2 == 0 ? 4.0 : -4.0) / 9 / n) / n;
    CHECK(star_discrepancy(hammersley(1u << m)) == doctest::Approx(expected));
  }
}

TEST_CASE("star discrepancy: that of the definition, equal coordinates included") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Points points = independent(1 + seed, seed);
    CHECK(star_discrepancy(points) == doctest::Approx(star_discrepancy_by_definition(points)));
    for (Vec2& p : points) p = 0.25f * Vec2{std::floor(4 * p.x), std::floor(4 * p.y)};
    CHECK(star_discrepancy(points) == doctest::Approx(star_discrepancy_by_definition(points)));
  }
}

TEST_CASE("net quality: Sobol' points are perfect nets, and so are their aligned blocks") {
  for (int m = 0; m <= 12; ++m) CHECK(net_quality(sobol(1u << m)) == 0);
  const Points all = sobol(256);
  for (std::size_t start = 0; start < 256; start += 32) {
    CHECK(net_quality(std::span(all).subspan(start, 32)) == 0);
  }
  CHECK(net_quality(std::span(all).subspan(16, 32)) > 0);
}

TEST_CASE("net quality: of a regular grid of 2^(2k) points it is k") {
  // The thinnest slabs that all hold the same number of points hold 2^k points each.
  for (int k = 0; k <= 5; ++k) CHECK(net_quality(grid(k, 0.5f)) == k);
}

TEST_CASE("net quality: points at one place, one point moved to another cell") {
  CHECK(net_quality(Points(64, Vec2{0.3f, 0.6f})) == 6);
  CHECK(fills_elementary_intervals(sobol(64)));
  // Moves a point to the other half of its column or row of width 2/64. Only the thinnest intervals
  // of one axis detect this.
  for (float Vec2::*axis : {&Vec2::x, &Vec2::y}) {
    Points points = sobol(64);
    float& value = points[10].*axis;
    value += std::fmod(value, 2.0f / 64) < 1.0f / 64 ? 1.0f / 64 : -1.0f / 64;
    CHECK_FALSE(fills_elementary_intervals(points));
    CHECK(net_quality(points) == 1);
  }
}

TEST_CASE("power spectrum: that of the definition, symmetric") {
  const Points points = independent(300, 3);  // more than one block, and the last is not full
  PowerSpectrum spectrum(9);
  CHECK(spectrum.at(1, 1) == 0);
  spectrum.add(points);
  for (int x = -9; x <= 9; ++x) {
    for (int y = -9; y <= 9; ++y) {
      const double expected = x == 0 && y == 0 ? 0 : power_by_definition(points, x, y);
      CHECK(spectrum.at(x, y) == doctest::Approx(expected).epsilon(1e-9));
      CHECK(spectrum.at(x, y) == spectrum.at(-x, -y));
    }
  }
}

TEST_CASE("power spectrum: the mean over realizations of any size") {
  const Points a = independent(7, 1), b = independent(300, 2);
  PowerSpectrum spectrum(3);
  spectrum.add(a);
  spectrum.add(b);
  CHECK(spectrum.count() == 2);
  CHECK(spectrum.at(2, -3) ==
        doctest::Approx((power_by_definition(a, 2, -3) + power_by_definition(b, 2, -3)) / 2));
}

TEST_CASE("power spectrum: independent points have a power of 1 at every frequency") {
  constexpr int kRealizations = 400;
  std::vector<double> means, corner;
  PowerSpectrum all(8);
  for (int i = 0; i < kRealizations; ++i) {
    const Points points = independent(64, 100 + static_cast<std::uint64_t>(i));
    PowerSpectrum one(8);
    one.add(points);
    all.add(points);
    double sum = 0;
    for (int x = -8; x <= 8; ++x) {
      for (int y = -8; y <= 8; ++y) sum += one.at(x, y);
    }
    means.push_back(sum / (17 * 17 - 1));
    corner.push_back(one.at(8, -8));
  }
  // The mean of 144 unrelated powers of standard deviation 1 over 400 realizations is known to 0.4
  // %.
  const Bounded mean = arithmetic_mean(means, 0.999);
  CHECK(mean.interval.low < 1);
  CHECK(mean.interval.high > 1);
  CHECK(mean.interval.high - mean.interval.low < 0.04);
  const Bounded single = arithmetic_mean(corner, 0.999);
  CHECK(single.interval.low < 1);
  CHECK(single.interval.high > 1);
  const std::vector<double> rings = all.ring_means();
  CHECK(rings.size() == 9);
  CHECK(rings[0] == 0);
  for (std::size_t r = 1; r < rings.size(); ++r)
    CHECK(rings[r] == doctest::Approx(1).epsilon(0.15));
}

TEST_CASE("power spectrum: a lattice has all its power on the dual lattice") {
  // For the points (i / 64, i 11 / 64 mod 1), waves (x, y) with x + 11 y divisible by 64 are in
  // phase.
  Points points;
  for (int i = 0; i < 64; ++i) {
    points.push_back({static_cast<float>(i) / 64, static_cast<float>(i * 11 % 64) / 64});
  }
  PowerSpectrum spectrum(20);
  spectrum.add(points);
  int in_phase = 0;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) {
      if (x == 0 && y == 0) continue;
      const bool dual = (x + 11 * y) % 64 == 0;
      in_phase += dual;
      CHECK(spectrum.at(x, y) == doctest::Approx(dual ? 64 : 0).epsilon(1e-9));
    }
  }
  CHECK(in_phase > 10);
}

TEST_CASE("power spectrum: a jittered grid's is 1 - sinc^2 but for its own frequencies") {
  // Each of m x m cells holds a uniform point. The variance of exp(-2 pi i f.p) within a cell is 1
  // - sinc^2(f_x / m) sinc^2(f_y / m). The means add up only if m divides both f_x and f_y, and
  // then they are zero.
  constexpr int kEdge = 8, kRealizations = 2000, kHighest = 16;
  PowerSpectrum spectrum(kHighest);
  RandomStream random(5);
  for (int i = 0; i < kRealizations; ++i) {
    Points points;
    for (int cell = 0; cell < kEdge * kEdge; ++cell) {
      const Vec2 corner{static_cast<float>(cell % kEdge), static_cast<float>(cell / kEdge)};
      points.push_back((1.0f / kEdge) * (corner + random.next_2d()));
    }
    spectrum.add(points);
  }
  for (int x = 0; x <= kHighest; ++x) {
    for (int y = -kHighest; y <= kHighest; ++y) {
      if (x == 0 && y == 0) continue;
      const double expected = 1 - sinc_squared(static_cast<double>(x) / kEdge) *
                                      sinc_squared(static_cast<double>(y) / kEdge);
      // The power is distributed like an exponential variable. The bound is five standard errors.
      CHECK(std::abs(spectrum.at(x, y) - expected) < 5 * expected / std::sqrt(kRealizations));
    }
  }
  CHECK(spectrum.ring_means()[1] < 0.1);
}

TEST_CASE("point sets: bad input") {
  const Points none, outside{{0.5f, 1}}, negative{{-0.1f, 0.5f}},
      unknown{{std::numeric_limits<float>::quiet_NaN(), 0}};
  PowerSpectrum spectrum(2);
  for (const Points* points : {&none, &outside, &negative, &unknown}) {
    CHECK_THROWS_AS(star_discrepancy(*points), InputError);
    CHECK_THROWS_AS(net_quality(*points), InputError);
    CHECK_THROWS_AS(fills_elementary_intervals(*points), InputError);
    CHECK_THROWS_AS(spectrum.add(*points), InputError);
  }
  CHECK(spectrum.count() == 0);
  CHECK_THROWS_AS(net_quality(independent(3, 1)), InputError);
  CHECK_THROWS_AS(PowerSpectrum(0), InputError);
  CHECK_THROWS_AS(spectrum.at(3, 0), InputError);
  CHECK_THROWS_AS(spectrum.at(0, -3), InputError);
}

}  // namespace pharos::statistics

// Compares the losses with closed forms, brute force and finite differences.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "../power_spectrum_loss.h"
#include "../wasserstein_loss.h"
#include "test_points.h"

namespace pharos::aligned {
namespace {

/// Frequencies with different signs, with targets and weights.
const std::vector<TargetPower> kFrequencies{{1, 0, 0, 1},     {0, 3, 0.5, 2}, {-4, 7, 0, 1},
                                            {5, -2, 1, 0.5},  {9, 9, 0, 3},   {0, -6, 2, 1.5},
                                            {-11, 0, 0.2, 1}, {5, 4, 0, 1}};

/// Evaluates the loss by its definition, in double precision.
double spectrum_by_definition(const Coordinates& points,
                              const std::vector<TargetPower>& frequencies) {
  double loss = 0, weights = 0;
  for (const TargetPower& v : frequencies) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      sum += std::polar(1.0, -2 * std::numbers::pi * (v.x * points.x[i] + v.y * points.y[i]));
    }
    const double error =
        std::abs(sum) / std::sqrt(static_cast<double>(points.size())) - std::sqrt(v.power);
    loss += v.weight * error * error;
    weights += v.weight;
  }
  return loss / weights;
}

/// Compares the gradient with central differences of `value` at some of the coordinates.
template <class Value>
void check_gradient(const Coordinates& points, const Coordinates& gradient, double width,
                    double tolerance, Value&& value) {
  double largest = 0;
  for (const double g : gradient.x) largest = std::max(largest, std::abs(g));
  REQUIRE(largest > 0);
  const auto slope = [&](std::vector<double> Coordinates::*axis, std::size_t i) {
    Coordinates above = points, below = points;
    (above.*axis)[i] += width;
    (below.*axis)[i] -= width;
    return (value(above) - value(below)) / (2 * width);
  };
  for (std::size_t i = 0; i < points.size(); i += 5) {
    CHECK(std::abs(gradient.x[i] - slope(&Coordinates::x, i)) < tolerance * largest);
    CHECK(std::abs(gradient.y[i] - slope(&Coordinates::y, i)) < tolerance * largest);
  }
}

}  // namespace

TEST_CASE("power spectrum loss: value and gradient by definition") {
  // Fewer points than a block, exactly one block, and two blocks with a remainder.
  for (const std::size_t count : {60u, 128u, 300u}) {
    CAPTURE(count);
    const Coordinates points = testing::random_points(count);
    const PowerSpectrumLoss loss(kFrequencies);
    Coordinates gradient(count);
    const double value = loss.evaluate(points, 3, gradient);
    CHECK(value == doctest::Approx(spectrum_by_definition(points, kFrequencies)).epsilon(1e-5));
    check_gradient(points, gradient, 1e-6, 1e-4, [](const Coordinates& p) {
      return 3 * spectrum_by_definition(p, kFrequencies);
    });
  }
}

TEST_CASE("power spectrum loss: high frequencies keep their digits") {
  const std::vector<TargetPower> high{{500, 511, 0, 1}, {-512, 300, 0, 1}};
  const Coordinates points = testing::random_points(256);
  Coordinates gradient(256);
  CHECK(PowerSpectrumLoss(high).evaluate(points, 1, gradient) ==
        doctest::Approx(spectrum_by_definition(points, high)).epsilon(1e-3));
}

TEST_CASE("power spectrum loss: gradients are added, and a lattice has no power to take away") {
  // 8 x 8 points in a grid: the power is zero at (1, 0) and (0, 3), and 64 at (8, 0).
  Coordinates grid(64);
  for (std::size_t i = 0; i < 64; ++i) {
    grid.x[i] = static_cast<double>(i % 8) / 8 + 0.3;
    grid.y[i] = static_cast<double>(i / 8) / 8;
  }
  Coordinates gradient(64);
  std::ranges::fill(gradient.x, 7.0);
  CHECK(PowerSpectrumLoss({{1, 0}, {0, 3}}).evaluate(grid, 1, gradient) < 1e-9);
  for (const double g : gradient.x) CHECK(g == doctest::Approx(7));
  CHECK(PowerSpectrumLoss({{8, 0, 60}}).evaluate(grid, 1, gradient) ==
        doctest::Approx(std::pow(8 - std::sqrt(60), 2)));
}

TEST_CASE("power spectrum loss: what cannot be descended on is refused") {
  CHECK_THROWS_AS(PowerSpectrumLoss({}), InputError);
  CHECK_THROWS_AS(PowerSpectrumLoss({{1, 2, 0, 0}}), InputError);
  CHECK_THROWS_AS(PowerSpectrumLoss({{1, 2}, {0, 0}}), InputError);
}

TEST_CASE("targets: equal shares of a square lie between them") {
  // Counts the centers of the cells of a fine grid below each quantile.
  constexpr int kEdge = 1000;
  for (const double degrees : {0.0, 3.0, 20.0, 45.0, 61.0, 90.0, 117.5, 135.0, 179.0}) {
    CAPTURE(degrees);
    const Direction d = direction_of(degrees);
    std::vector<double> projected;
    projected.reserve(kEdge * kEdge);
    for (int i = 0; i < kEdge * kEdge; ++i) {
      const double x = (i % kEdge + 0.5) / kEdge - 0.5, y = (i / kEdge + 0.5) / kEdge - 0.5;
      projected.push_back(x * d.x + y * d.y);
    }
    std::ranges::sort(projected);
    for (const double u : {-0.499, -0.41, -0.2, -0.03, 0.0, 0.01, 0.3, 0.45, 0.4999}) {
      CAPTURE(u);
      const auto below = std::ranges::lower_bound(projected, projected_quantile(d, u));
      const double share =
          static_cast<double>(below - projected.begin()) / static_cast<double>(projected.size());
      CHECK(std::abs(share - (u + 0.5)) < 2.0 / kEdge);
    }
  }
}

TEST_CASE("targets: the square's extent, without a gap where the formula changes") {
  const Direction d = direction_of(25);
  CHECK(projected_quantile(d, 0.5) == doctest::Approx((d.x + d.y) / 2));
  CHECK(projected_quantile(d, -0.5) == doctest::Approx(-(d.x + d.y) / 2));
  const double change = (d.x - d.y) / (2 * d.x);
  CHECK(std::abs(projected_quantile(d, change + 1e-9) - projected_quantile(d, change - 1e-9)) <
        1e-8);
}

TEST_CASE("Wasserstein loss: value and gradient by definition") {
  const std::vector<Direction> directions{direction_of(0), direction_of(90), direction_of(33),
                                          direction_of(140)};
  constexpr std::size_t kCount = 80;
  const Coordinates points = testing::random_points(kCount);
  const WassersteinLoss loss(directions, kCount);
  Coordinates gradient(kCount);
  const double value = loss.evaluate(points, 2, gradient);
  double expected = 0;
  for (const Direction d : directions) {
    std::vector<double> projected;
    for (std::size_t i = 0; i < kCount; ++i) {
      projected.push_back((points.x[i] - 0.5) * d.x + (points.y[i] - 0.5) * d.y);
    }
    std::ranges::sort(projected);
    for (std::size_t j = 0; j < kCount; ++j) {
      const double u = (static_cast<double>(j) + 0.5) / kCount - 0.5;
      expected += std::pow(kCount * (projected[j] - projected_quantile(d, u)), 2);
    }
  }
  CHECK(value == doctest::Approx(expected / (4.0 * kCount)));
  check_gradient(points, gradient, 1e-8, 1e-5, [&](const Coordinates& p) {
    Coordinates unused(kCount);
    return 2 * loss.evaluate(p, 1, unused);
  });
}

TEST_CASE("Wasserstein loss: none for points on the targets") {
  constexpr std::size_t kCount = 64;
  Coordinates diagonal(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    diagonal.x[i] = diagonal.y[kCount - 1 - i] = (static_cast<double>(i) + 0.5) / kCount;
  }
  const std::vector axes{direction_of(0), direction_of(90)};
  Coordinates gradient(kCount);
  CHECK(WassersteinLoss(axes, kCount).evaluate(diagonal, 1, gradient) < 1e-20);
  const std::vector<Direction> other{direction_of(45)};
  CHECK(WassersteinLoss(other, kCount).evaluate(diagonal, 1, gradient) > 1);
}

}  // namespace pharos::aligned

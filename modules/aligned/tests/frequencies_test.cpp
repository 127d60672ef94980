// Tests of the selection of suppressed frequencies.

#include "../frequencies.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace pharos::aligned {
namespace {

std::vector<Direction> axes_and(const std::vector<double>& degrees) {
  std::vector<Direction> all{direction_of(0), direction_of(90)};
  for (const double d : degrees) all.push_back(direction_of(d));
  return all;
}

bool holds(const std::vector<TargetPower>& all, int x, int y) {
  return std::ranges::any_of(all, [&](const TargetPower& v) { return v.x == x && v.y == y; });
}

/// Computes the energy of an edge in the unit square at a frequency by summing waves along the
/// edge. The edge has length `length`, its midpoint is the center, and its normal has the angle
/// `degrees`. The result is relative to the constant factor of edge_energy().
double energy_by_definition(const TargetPower& v, double degrees, double length) {
  constexpr int kParts = 4000;
  const Direction n = direction_of(degrees);
  const double across = v.x * n.y - v.y * n.x, squared = v.x * v.x + v.y * v.y;
  std::complex<double> sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double along = length * ((i + 0.5) / kParts - 0.5);
    sum += std::polar(1.0 / kParts, -2 * std::numbers::pi * across * along);
  }
  const double normal = v.x * n.x + v.y * n.y;
  return std::norm(sum) * normal * normal / (squared * squared);
}

}  // namespace

TEST_CASE("energy: an edge's, with its waves smoothed") {
  const SuppressionRule rule{.exact = 1, .edge_length = 0.7};
  const Direction d = direction_of(30);
  for (const auto& frequency : {std::pair{4, 1}, {7, 4}, {-5, 12}, {40, 21}, {33, 60}}) {
    const int x = frequency.first, y = frequency.second;
    CAPTURE(x);
    CAPTURE(y);
    // Lengths around the rule's length produce all phases of the waves.
    double mean = 0;
    constexpr int kLengths = 200;
    for (int i = 0; i < kLengths; ++i) {
      mean += energy_by_definition({x, y}, 30, 0.7 * (0.5 + (i + 0.5) / kLengths)) / kLengths;
    }
    const double ratio = edge_energy(x, y, d, rule) / mean;
    // If about one wave fits into the edge, the smoothed energy is half too low.
    CHECK(ratio > 0.45);
    CHECK(ratio < 1.6);
  }
  CHECK(edge_energy(3, 4, direction_of(0), rule) ==
        doctest::Approx(9.0 / 625 / (1 + 2 * std::pow(std::numbers::pi * 0.7 * 4, 2)))
            .epsilon(1e-9)
            .scale(0));
}

TEST_CASE("energy: the mean over the normals within the half angle") {
  const SuppressionRule sharp{.exact = 1}, spread{.exact = 0}, mixed{.exact = 0.25};
  for (const auto& frequency : {std::pair{17, 10}, {16, 11}, {20, 0}, {-3, 25}}) {
    const int x = frequency.first, y = frequency.second;
    CAPTURE(x);
    CAPTURE(y);
    double mean = 0;
    for (int i = 0; i < 1000; ++i) {
      mean += edge_energy(x, y, direction_of(30 - 5 + 10 * (i + 0.5) / 1000), sharp) / 1000;
    }
    CHECK(edge_energy(x, y, direction_of(30), spread) ==
          doctest::Approx(mean).epsilon(0.03).scale(0));
    const double both = 0.25 * edge_energy(x, y, direction_of(30), sharp) +
                        0.75 * edge_energy(x, y, direction_of(30), spread);
    CHECK(edge_energy(x, y, direction_of(30), mixed) ==
          doctest::Approx(both).epsilon(1e-9).scale(0));
  }
  // The mean exists for any width.
  const SuppressionRule narrow{.exact = 0, .half_angle = 1e-13};
  CHECK(edge_energy(17, 10, direction_of(30), narrow) ==
        doctest::Approx(edge_energy(17, 10, direction_of(30), sharp)).epsilon(1e-9).scale(0));
  // The normals of an axis are exact.
  CHECK(edge_energy(20, 1, direction_of(0), spread) == edge_energy(20, 1, direction_of(0), sharp));
}

TEST_CASE("energy: the mean over all normals, the same for all frequencies of a length") {
  const SuppressionRule sharp{.exact = 1};
  for (const auto& frequency : {std::pair{2, 1}, {17, 10}, {-3, 25}}) {
    const int x = frequency.first, y = frequency.second;
    CAPTURE(x);
    CAPTURE(y);
    double mean = 0;
    for (int i = 0; i < 3600; ++i) {
      mean += edge_energy(x, y, direction_of((i + 0.5) / 20), sharp) / 3600;
    }
    CHECK(mean_edge_energy(x, y, sharp) == doctest::Approx(mean).epsilon(1e-3).scale(0));
    CHECK(mean_edge_energy(x, y, sharp) == mean_edge_energy(-y, x, sharp));
  }
}

TEST_CASE("frequencies: a half plane, each but once, those of most energy, weighted by it") {
  SuppressionRule rule;
  rule.share = 0.5;
  const std::vector<Direction> directions = axes_and({30});
  const auto all = suppressed_frequencies(1024, directions, rule);
  CHECK(all.size() <= 512);
  CHECK(all.size() > 500);
  const auto energy = [&](int x, int y) {
    double sum = rule.anywhere * mean_edge_energy(x, y, rule);
    for (const Direction d : directions) sum += edge_energy(x, y, d, rule);
    return sum;
  };
  std::set<std::pair<int, int>> seen;
  double least = 1e30, weights = 0;
  for (const TargetPower& v : all) {
    CHECK((v.y > 0 || (v.y == 0 && v.x > 0)));
    CHECK(seen.emplace(v.x, v.y).second);
    CHECK(v.power == 0);
    CHECK(std::hypot(v.x, v.y) <= rule.radius * 32);
    least = std::min(least, energy(v.x, v.y));
    weights += v.weight;
    CHECK(v.weight / all[0].weight ==
          doctest::Approx(energy(v.x, v.y) / energy(all[0].x, all[0].y)));
  }
  CHECK(weights == doctest::Approx(static_cast<double>(all.size())));
  for (int y = 0; y <= 40; ++y) {
    for (int x = y == 0 ? 1 : -40; x <= 40; ++x) {
      if (!holds(all, x, y)) CHECK(energy(x, y) <= least * (1 + 1e-8));
    }
  }
  // The frequencies reach far along each line and not far across it: the direction of 30 degrees is
  // (1.732, 1).
  CHECK(holds(all, 26, 15));
  CHECK(holds(all, 0, 40));
  CHECK_FALSE(holds(all, -26, 15));
}

TEST_CASE("frequencies: none beyond the radius, symmetric where the directions are") {
  for (const std::uint32_t points : {64u, 256u, 4096u}) {
    CAPTURE(points);
    SuppressionRule rule;
    rule.radius = 1;
    rule.share = 16;
    const auto all = suppressed_frequencies(points, axes_and({45}), rule);
    const int edge = static_cast<int>(std::sqrt(points));
    CHECK(holds(all, edge, 0));
    CHECK_FALSE(holds(all, edge, 1));
    rule.share = 0.4;
    const auto few = suppressed_frequencies(points, axes_and({45}), rule);
    CHECK(few.size() < all.size());
    // The frequencies remain the same if the axes are swapped.
    for (const TargetPower& v : few) {
      CHECK((v.x >= 0 ? holds(few, v.y, v.x) : holds(few, -v.y, -v.x)));
    }
  }
}

TEST_CASE("directions: modulo 180 degrees, the axes exact") {
  CHECK(direction_of(0).y == 0);
  CHECK(direction_of(90).x == 0);
  CHECK(direction_of(-90).x == 0);
  CHECK(direction_of(360).x == 1);
  CHECK(direction_of(-150).x == doctest::Approx(direction_of(30).x));
  CHECK(direction_of(120).x == doctest::Approx(-0.5));
}

}  // namespace pharos::aligned

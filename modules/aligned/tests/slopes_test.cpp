// Tests how the variance of integrals of edges falls with the number of points, for sets that are
// made for the edge's direction and for points without directions.

#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/parallel.h>
#include <pharos/core/random.h>
#include <pharos/laboratory/integrands/edge.h>

#include "../point_set_library.h"
#include "../shipped_sets.h"

namespace pharos::aligned {
namespace {

constexpr int kShifts = 400;
const std::vector<double> kAngles{7, 14, 23, 31, 38, 52, 66, 74, 108, 121, 139, 157};

/// Returns the mean squared error of the edge's integral over random toroidal shifts of the points.
double variance(const PointSet& set, double degrees, std::uint64_t seed) {
  laboratory::Edge::Settings settings;
  settings.angles = {degrees};
  const laboratory::Edge edge(settings);
  const std::vector<Vec2> points = positions(set);
  RandomStream random(seed, set.size());
  double sum = 0;
  for (int i = 0; i < kShifts; ++i) {
    const Vec2 shift = random.next_2d();
    double inside = 0;
    for (const Vec2 p : points) {
      const Vec2 moved = p + shift;
      inside += edge({moved.x - std::floor(moved.x), moved.y - std::floor(moved.y)});
    }
    sum += std::pow(inside / static_cast<double>(points.size()) - edge.mean(), 2);
  }
  return sum / kShifts;
}

using MakeSet = std::function<PointSet(double degrees, std::uint32_t points)>;

/// Returns the mean over all angles for each shipped size.
std::vector<double> variances(const MakeSet& make) {
  std::vector<double> all;
  for (const std::uint32_t points : kShippedSizes) {
    std::vector<double> by_angle(kAngles.size());
    parallel_for(kAngles.size(), [&](std::size_t i) {
      by_angle[i] = variance(make(kAngles[i], points), kAngles[i], i);
    });
    all.push_back(std::accumulate(by_angle.begin(), by_angle.end(), 0.0) /
                  static_cast<double>(by_angle.size()));
  }
  return all;
}

/// Returns the slope of the logarithm of the variance over the logarithm of the number of points,
/// by least squares.
double slope(const std::vector<double>& variances) {
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < variances.size(); ++i) {
    const double x = std::log(4) * (static_cast<double>(i) - 1.5);
    xy += x * std::log(variances[i]);
    xx += x * x;
  }
  return xy / xx;
}

}  // namespace

TEST_CASE("slopes: with matching directions steeper than of a jittered grid, and far lower") {
  const PointSetLibrary library({.cache_folder = "unused"});
  const auto aligned = variances([&](double degrees, std::uint32_t points) {
    return library.find(std::vector<double>{degrees}, points);
  });
  const auto jittered = variances([](double degrees, std::uint32_t points) {
    return jittered_grid(points, static_cast<std::uint64_t>(degrees));
  });
  CAPTURE(slope(aligned));
  CAPTURE(slope(jittered));
  CHECK(slope(aligned) < -1.7);
  CHECK(slope(jittered) > -1.58);
  CHECK(slope(jittered) < -1.42);
  CHECK(aligned.back() < 0.15 * jittered.back());
}

TEST_CASE("slopes: five degrees off there is still a gain") {
  const PointSetLibrary library({.cache_folder = "unused"});
  const auto off = variances([&](double degrees, std::uint32_t points) {
    return library.find(std::vector<double>{degrees + 5}, points);
  });
  const auto jittered = variances([](double degrees, std::uint32_t points) {
    return jittered_grid(points, static_cast<std::uint64_t>(degrees));
  });
  CHECK(off.back() < 0.3 * jittered.back());
}

}  // namespace pharos::aligned

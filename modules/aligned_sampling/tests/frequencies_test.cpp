// Which frequencies are suppressed.

#include "../frequencies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
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

/// The angle between lines [degrees].
double angle_between(const TargetPower& v, double degrees) {
  const double difference = std::atan2(v.y, v.x) * 180 / std::numbers::pi - degrees;
  return std::abs(difference - 180 * std::round(difference / 180));
}

}  // namespace

TEST_CASE("frequencies: a half plane, each but once, near a direction and none further") {
  const SuppressionRule rule{.radius = 1.5, .half_angle = 6, .strip = 0.25, .share = 2};
  const auto all = suppressed_frequencies(1024, axes_and({30}), rule);
  std::set<std::pair<int, int>> seen;
  for (const TargetPower& v : all) {
    CAPTURE(v.x);
    CAPTURE(v.y);
    CHECK((v.y > 0 || (v.y == 0 && v.x > 0)));
    CHECK(seen.emplace(v.x, v.y).second);
    CHECK(v.power == 0);
    const double length = std::hypot(v.x, v.y);
    CHECK(length <= 1.5 * 32);
    bool is_near = false;
    for (const double d : {0.0, 90.0, 30.0}) {
      const double angle = angle_between(v, d);
      is_near |= angle <= 6.0001;
      is_near |= length * std::sin(angle * std::numbers::pi / 180) <= 1.4143;
    }
    CHECK(is_near);
  }
  // Within and beyond the wedges: 30 degrees is (1.732, 1), and 4 / 40 is 5.7 degrees.
  CHECK(holds(all, 35, 20));
  CHECK(holds(all, 40, 4));
  CHECK(holds(all, -40, 4));
  CHECK(holds(all, 0, 48));
  CHECK_FALSE(holds(all, 0, 49));
  CHECK_FALSE(holds(all, 40, 5));
  CHECK_FALSE(holds(all, -35, 20));
}

TEST_CASE("frequencies: no more than their share, the shortest of them, symmetric") {
  for (const std::uint32_t points : {64u, 256u, 4096u}) {
    CAPTURE(points);
    SuppressionRule rule;
    rule.share = 0.5;
    const auto all = suppressed_frequencies(points, axes_and({45}), rule);
    CHECK(all.size() <= points / 2);
    CHECK(all.size() > points / 4);
    // The axes may change places.
    for (const TargetPower& v : all) {
      CHECK((v.x >= 0 ? holds(all, v.y, v.x) : holds(all, -v.y, -v.x)));
    }
    rule.share = 10;
    double longest = 0;
    for (const TargetPower& v : all) longest = std::max(longest, std::hypot(v.x, v.y));
    for (const TargetPower& v : suppressed_frequencies(points, axes_and({45}), rule)) {
      if (std::hypot(v.x, v.y) <= longest) CHECK(holds(all, v.x, v.y));
    }
  }
}

TEST_CASE("frequencies: weights have the mean 1 and fall as they are told") {
  SuppressionRule rule;
  rule.low_frequencies = 2;
  const auto all = suppressed_frequencies(256, axes_and({}), rule);
  double sum = 0;
  for (const TargetPower& v : all) {
    sum += v.weight;
    CHECK(v.weight * (v.x * v.x + v.y * v.y) == doctest::Approx(all[0].weight));
  }
  REQUIRE(all[0].x * all[0].x + all[0].y * all[0].y == 1);
  CHECK(sum == doctest::Approx(static_cast<double>(all.size())));
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

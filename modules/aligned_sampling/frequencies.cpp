#include "frequencies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pharos::aligned {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

int squared_length(const TargetPower& v) {
  return v.x * v.x + v.y * v.y;
}

/// The frequencies of the half plane in the wedges and strips.
std::vector<TargetPower> members(std::uint32_t points, std::span<const Direction> directions,
                                 const SuppressionRule& rule) {
  const double longest = rule.radius * std::sqrt(points);
  const double strip = rule.strip * std::sqrt(std::sqrt(points));
  const double slope = std::tan(rule.half_angle * kRadians);
  const auto is_near = [&](int x, int y) {
    return std::ranges::any_of(directions, [&](const Direction& d) {
      const double along = std::abs(x * d.x + y * d.y), across = std::abs(x * d.y - y * d.x);
      return across <= std::max(strip, slope * along);
    });
  };
  std::vector<TargetPower> all;
  const int edge = static_cast<int>(longest);
  for (int y = 0; y <= edge; ++y) {
    for (int x = y == 0 ? 1 : -edge; x <= edge; ++x) {
      if (x * x + y * y <= longest * longest && is_near(x, y)) all.push_back({x, y});
    }
  }
  return all;
}

/// Leaves the shortest, at most `most`, all of a length or none.
void keep_shortest(std::vector<TargetPower>& frequencies, std::size_t most) {
  if (frequencies.size() <= most) return;
  std::ranges::stable_sort(frequencies, {}, squared_length);
  const int first_left_out = squared_length(frequencies[most]);
  std::erase_if(frequencies,
                [&](const TargetPower& v) { return squared_length(v) >= first_left_out; });
}

void set_weights(std::vector<TargetPower>& frequencies, double exponent) {
  double sum = 0;
  for (TargetPower& v : frequencies) {
    v.weight = std::pow(squared_length(v), -0.5 * exponent);
    sum += v.weight;
  }
  for (TargetPower& v : frequencies) v.weight *= static_cast<double>(frequencies.size()) / sum;
}

}  // namespace

void TargetPower::describe(Schema<TargetPower>& s) {
  constexpr int kHighest = 2048;
  s.field("x", &TargetPower::x, "Frequency")
      .unit("1/edge")
      .required()
      .at_least(-kHighest)
      .at_most(kHighest);
  s.field("y", &TargetPower::y, "Frequency")
      .unit("1/edge")
      .required()
      .at_least(-kHighest)
      .at_most(kHighest);
  s.field("power", &TargetPower::power, "What its power should be; 1 is that of random points")
      .at_least(0);
  s.field("weight", &TargetPower::weight, "Weight of its squared error").at_least(0);
}

void SuppressionRule::describe(Schema<SuppressionRule>& s) {
  s.field("radius", &SuppressionRule::radius, "Highest length of suppressed frequencies")
      .unit("square root of the number of points")
      .above(0)
      .at_most(4);
  s.field("half_angle", &SuppressionRule::half_angle, "Of the wedge about each direction")
      .unit("degrees")
      .at_least(0)
      .at_most(45);
  s.field("strip", &SuppressionRule::strip,
          "Frequencies as near as this to a direction's line are suppressed, too")
      .unit("fourth root of the number of points")
      .at_least(0);
  s.field("share", &SuppressionRule::share,
          "Most frequencies that are suppressed: if there were more, the radius is shorter")
      .unit("number of points")
      .above(0);
  s.field("low_frequencies", &SuppressionRule::low_frequencies,
          "Errors are weighted by the length of the frequency to the power of minus this")
      .at_least(0)
      .at_most(4);
}

Direction direction_of(double degrees) {
  const double turned = degrees - 180 * std::floor(degrees / 180);
  if (turned == 0) return {1, 0};
  if (turned == 90) return {0, 1};
  return {std::cos(turned * kRadians), std::sin(turned * kRadians)};
}

std::vector<TargetPower> suppressed_frequencies(std::uint32_t points,
                                                std::span<const Direction> directions,
                                                const SuppressionRule& rule) {
  std::vector<TargetPower> all = members(points, directions, rule);
  keep_shortest(all, static_cast<std::size_t>(rule.share * points));
  set_weights(all, rule.low_frequencies);
  return all;
}

}  // namespace pharos::aligned

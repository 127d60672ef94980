#include "frequencies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

namespace pharos::aligned {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// Returns the mean of 1 / (1 + (slope sin phi)^2) over the angles phi from `first` to `last`,
/// within a right angle, as if the sine increased linearly between them.
double mean_across(double slope, double first, double last) {
  constexpr double kNarrow = 1e-6;  // quotients of smaller differences consist of rounding errors
  if (last - first < kNarrow) return 1 / (1 + slope * std::sin(first) * slope * std::sin(first));
  const double to = slope * std::sin(std::min(last, std::numbers::pi / 2));
  const double from = slope * std::sin(first);
  return (std::atan(to) - std::atan(from)) / (to - from);
}

/// Returns how fast the energy of an edge falls as the sine of the angle between its frequency and
/// the normal grows.
double slope_of(double squared_length, const SuppressionRule& rule) {
  return std::numbers::sqrt2 * std::numbers::pi * rule.edge_length * std::sqrt(squared_length);
}

/// Keeps the frequencies with the highest weights, at most `most`. Of frequencies with equal
/// weights it keeps all or none.
void keep_heaviest(std::vector<TargetPower>& frequencies, std::size_t most) {
  if (frequencies.size() <= most) return;
  const auto first_left_out = frequencies.begin() + static_cast<std::ptrdiff_t>(most);
  std::ranges::nth_element(frequencies, first_left_out, std::greater{}, &TargetPower::weight);
  // Weights that are equal by symmetry differ by rounding.
  const double bound = first_left_out->weight * (1 + 1e-9);
  std::erase_if(frequencies, [&](const TargetPower& v) { return v.weight <= bound; });
}

/// Divides weights by their mean.
void normalize(std::vector<TargetPower>& frequencies) {
  double sum = 0;
  for (const TargetPower& v : frequencies) sum += v.weight;
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
  s.field("power", &TargetPower::power, "Target power; random points have 1").at_least(0);
  s.field("weight", &TargetPower::weight, "Weight of the error of this power").at_least(0);
}

void SuppressionRule::describe(Schema<SuppressionRule>& s) {
  s.field("radius", &SuppressionRule::radius, "Largest length of suppressed frequencies")
      .unit("square root of the number of points")
      .above(0)
      .at_most(8);
  s.field("exact", &SuppressionRule::exact,
          "Share of edges whose normal is assumed to be exactly a direction")
      .at_least(0)
      .at_most(1);
  s.field("half_angle", &SuppressionRule::half_angle,
          "Largest assumed angle between the normals of the other edges and a direction")
      .unit("degrees")
      .at_least(0)
      .at_most(45);
  s.field("edge_length", &SuppressionRule::edge_length, "Assumed length of edges")
      .unit("edge of the square")
      .above(0)
      .at_most(1.5);
  s.field("anywhere", &SuppressionRule::anywhere,
          "Number of edges with arbitrary normals for each edge along one direction")
      .at_least(0)
      .at_most(16);
  s.field(
       "share", &SuppressionRule::share,
       "Largest number of suppressed frequencies; those with most energy of such edges are taken")
      .unit("number of points")
      .above(0)
      .at_most(16);
}

Direction direction_of(double degrees) {
  const double turned = degrees - 180 * std::floor(degrees / 180);
  if (turned == 0) return {1, 0};
  if (turned == 90) return {0, 1};
  return {std::cos(turned * kRadians), std::sin(turned * kRadians)};
}

double edge_energy(int x, int y, Direction normal, const SuppressionRule& rule) {
  const double squared = static_cast<double>(x) * x + static_cast<double>(y) * y;
  const double along = std::abs(x * normal.x + y * normal.y);
  const double across = std::abs(x * normal.y - y * normal.x);
  const bool is_axis = normal.x == 0 || normal.y == 0;
  const double angle = std::atan2(across, along);
  const double spread = rule.half_angle * kRadians, exact = is_axis ? 1 : rule.exact;
  const double slope = slope_of(squared, rule);
  const double mean = exact * mean_across(slope, angle, angle) +
                      (1 - exact) * mean_across(slope, angle - spread, angle + spread);
  return along * along / (squared * squared) * mean;
}

double mean_edge_energy(int x, int y, const SuppressionRule& rule) {
  // The mean of cos^2 / (1 + (slope sin)^2) / |v|^2 over all angles.
  const double squared = static_cast<double>(x) * x + static_cast<double>(y) * y;
  const double slope = slope_of(squared, rule);
  return 1 / ((1 + std::sqrt(1 + slope * slope)) * squared);
}

std::vector<TargetPower> suppressed_frequencies(std::uint32_t points,
                                                std::span<const Direction> directions,
                                                const SuppressionRule& rule) {
  const double longest = rule.radius * std::sqrt(points);
  const int edge = static_cast<int>(longest);
  std::vector<TargetPower> all;
  for (int y = 0; y <= edge; ++y) {
    for (int x = y == 0 ? 1 : -edge; x <= edge; ++x) {
      if (std::hypot(x, y) > longest) continue;
      double energy = rule.anywhere * mean_edge_energy(x, y, rule);
      for (const Direction& d : directions) energy += edge_energy(x, y, d, rule);
      all.push_back({x, y, 0, energy});
    }
  }
  keep_heaviest(all, static_cast<std::size_t>(rule.share * points));
  normalize(all);
  return all;
}

}  // namespace pharos::aligned

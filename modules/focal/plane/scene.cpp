#include "scene.h"

#include <cmath>

namespace pharos::focal::plane {

std::vector<Interval> GapScene::gaps() const {
  std::vector<Interval> all;
  for (int i = 0; i < gap_count; ++i) {
    const double center = (i - 0.5 * (gap_count - 1)) * gap_distance;
    all.push_back({center - 0.5 * gap_width, center + 0.5 * gap_width});
  }
  return all;
}

bool GapScene::sees_light(double x, double angle) const {
  const double slope = std::tan(angle);
  if (std::abs(x + light_height * slope) > light_half_width) return false;
  const double crossing = x + obstacle_height * slope;
  const std::vector<Interval> open = gaps();
  return std::any_of(open.begin(), open.end(), [crossing](const Interval& gap) {
    return gap.low <= crossing && crossing <= gap.high;
  });
}

std::vector<Interval> GapScene::lit_angles(double x) const {
  const double leftmost = std::atan((-light_half_width - x) / light_height);
  const double rightmost = std::atan((light_half_width - x) / light_height);
  std::vector<Interval> lit;
  for (const Interval& gap : gaps()) {
    const Interval seen{std::max(std::atan((gap.low - x) / obstacle_height), leftmost),
                        std::min(std::atan((gap.high - x) / obstacle_height), rightmost)};
    if (seen.low < seen.high) lit.push_back(seen);
  }
  return lit;
}

double GapScene::irradiance(double x) const {
  double sum = 0;
  for (const Interval& lit : lit_angles(x)) sum += std::sin(lit.high) - std::sin(lit.low);
  return sum;
}

double GapScene::mean_irradiance() const {
  constexpr int kPoints = 4096;  // number of points of the midpoint rule
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    sum += irradiance(floor_half_width * (2 * (i + 0.5) / kPoints - 1));
  }
  return sum / kPoints;
}

}  // namespace pharos::focal::plane

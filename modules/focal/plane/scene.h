#pragma once

#include <algorithm>
#include <vector>

namespace pharos::focal::plane {

/// An interval between two numbers. It is empty unless low < high.
struct Interval {
  double low = 0, high = 0;
};

/// The two-dimensional scene of the experiment (Rath et al. 2023, section 6.6 and fig. 8): a floor
/// along y = 0, above it an obstacle with gaps, and above both a light of radiance 1. All three are
/// centered about x = 0. No light passes beside the obstacle. Lengths are in scene units. Angles
/// are in radians from the floor's normal, positive to the right.
///
/// The paper states no dimensions. The dimensions are those of the authors' demonstration, except
/// for the light: there it is infinite; here it ends beyond the part that any point of the floor
/// sees.
struct GapScene {
  double floor_half_width = 1;
  double obstacle_height = 0.5;
  double light_height = 1, light_half_width = 1.5;
  int gap_count = 3;
  double gap_width = 0.01;
  double gap_distance = 0.2;  ///< distance between the centers of neighboring gaps

  /// Returns half of the scene's width: the larger half-width of the floor and the light.
  double half_width() const { return std::max(floor_half_width, light_half_width); }
  /// Returns the gaps of the obstacle, from left to right.
  std::vector<Interval> gaps() const;
  /// Returns whether the ray from the floor at `x` reaches the light.
  bool sees_light(double x, double angle) const;
  /// Returns the angles at which the floor at `x` sees the light: one interval for each gap through
  /// which it sees the light.
  std::vector<Interval> lit_angles(double x) const;
  /// Returns the integral of radiance times cosine over all angles, in closed form.
  double irradiance(double x) const;
  /// Returns the mean of irradiance() over the floor. The relative error of the quadrature is below
  /// 1e-6.
  double mean_irradiance() const;
};

}  // namespace pharos::focal::plane

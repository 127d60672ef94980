#pragma once

#include <algorithm>
#include <vector>

namespace pharos::focal::plane {

/// A stretch between two numbers; empty unless low < high.
struct Interval {
  double low = 0, high = 0;
};

/// The flat world of the experiment (Rath et al. 2023, section 6.6 and fig. 8): a floor along
/// y = 0, an obstacle with gaps above it, and a light of radiance 1 above both. All three are
/// centered about x = 0; nothing passes beside the obstacle. Lengths in scene units, and angles in
/// radians from the floor's normal, positive to the right.
///
/// The paper states no measures. These are the authors' demonstration's, but for the light: there
/// it has no end, here it ends beyond what any point of the floor sees of it.
struct GapScene {
  double floor_half_width = 1;
  double obstacle_height = 0.5;
  double light_height = 1, light_half_width = 1.5;
  int gap_count = 3;
  double gap_width = 0.01;
  double gap_distance = 0.2;  ///< between the centres of neighboring gaps

  /// Of the world: of the floor or the light, whichever is wider.
  double half_width() const { return std::max(floor_half_width, light_half_width); }
  /// Where the obstacle is open, from left to right.
  std::vector<Interval> gaps() const;
  /// Whether the ray from the floor at `x` reaches the light.
  bool sees_light(double x, double angle) const;
  /// The angles at which the floor at `x` sees the light, one interval for each gap that shows any.
  std::vector<Interval> lit_angles(double x) const;
  /// The integral of radiance times cosine over all angles, in closed form.
  double irradiance(double x) const;
  /// The mean of irradiance() over the floor; the error of quadrature is below 1e-6 of it.
  double mean_irradiance() const;
};

}  // namespace pharos::focal::plane

#pragma once

#include <pharos/config/schema.h>
#include <pharos/core/vec.h>
#include <pharos/laboratory/convex_region.h>

namespace pharos::laboratory {

/// A map from the square to the directions of a hemisphere.
enum class HemisphereMap {
  polar,       ///< density cosine / pi; x is the squared sine of the angle to +z, y the azimuth
  concentric,  ///< density cosine / pi; by way of the disk (Shirley and Chiu 1997)
  octahedral   ///< keeps straight edges straight (Engelhardt and Dachsbacher 2008)
};

/// half_sky: direct light on a matt surface below a sky that is black on one side of a straight
/// edge, as an integrand of the two numbers that choose the direction. A straight edge in space is
/// a great circle of directions, so the sky is a half space through the origin. The value is
/// cos / (pi p) inside, where p is the density of the map's directions [1/sr], and 0 outside. The
/// mean is the form factor of the half space, (1 + cos tilt) / 2.
class HalfSky {
 public:
  struct Settings {
    HemisphereMap map = HemisphereMap::octahedral;
    double azimuth = 20;
    double tilt = 60;
    static void describe(Schema<Settings>& schema);
  };

  explicit HalfSky(const Settings& settings);

  double operator()(PlanePoint p) const;
  double mean() const { return mean_; }

 private:
  HemisphereMap map_;
  Vec3 inward_;  ///< normal of the plane, on the side of the sky
  double mean_;
};

}  // namespace pharos::laboratory

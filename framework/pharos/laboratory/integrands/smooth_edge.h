#pragma once

#include <cmath>
#include <numbers>

#include <pharos/config/schema.h>
#include <pharos/laboratory/convex_region.h>

namespace pharos::laboratory {

/// smooth_edge: a straight edge blurred by a Gaussian. Its value is Phi(-d / width) at the signed
/// distance d, where Phi is the standard normal distribution function. The mean is a second
/// difference of the second integral of Phi over the corners of the square. For edges along an axis
/// it is a first difference of the first integral.
class SmoothEdge {
 public:
  struct Settings {
    double angle = 30;
    double offset = 0;
    double width = 0.05;
    static void describe(Schema<Settings>& schema);
  };

  explicit SmoothEdge(const Settings& settings)
      : edge_(half_plane(settings.angle, settings.offset)), width_(settings.width) {}

  double operator()(PlanePoint p) const {
    return 0.5 * std::erfc(edge_.signed_distance(p) / (width_ * std::numbers::sqrt2));
  }
  double mean() const;

 private:
  HalfPlane edge_;
  double width_;
};

}  // namespace pharos::laboratory

#pragma once

#include <cmath>
#include <numbers>

#include <pharos/config/schema.h>
#include <pharos/laboratory/integrand.h>

namespace pharos::laboratory {

/// smooth: the sum of the Gaussian exp(-|p - center|^2 / (2 width^2)) and all its periodic images,
/// which makes it a function on the torus without borders. Each part of the Gaussian on the plane
/// appears in the square exactly once, so the mean is 2 pi width^2.
class Smooth {
 public:
  struct Settings {
    Vec2 center{0.5f, 0.5f};
    double width = 0.15;
    static void describe(Schema<Settings>& schema);
  };

  explicit Smooth(const Settings& settings)
      : center_{settings.center.x, settings.center.y},
        width_(settings.width),
        images_(static_cast<int>(0.5 + kReach * settings.width)) {}

  double operator()(PlanePoint p) const {
    return along_axis(p.x - center_.x) * along_axis(p.y - center_.y);
  }
  double mean() const { return 2 * std::numbers::pi * width_ * width_; }

 private:
  /// Images that are everywhere further away than this [widths] add less than 1e-16.
  static constexpr double kReach = 8.6;

  double along_axis(double d) const {
    d -= std::round(d);
    double sum = 0;
    for (int image = -images_; image <= images_; ++image) {
      const double t = (d + image) / width_;
      sum += std::exp(-0.5 * t * t);
    }
    return sum;
  }

  PlanePoint center_;
  double width_;
  int images_;  ///< number of images on either side
};

}  // namespace pharos::laboratory

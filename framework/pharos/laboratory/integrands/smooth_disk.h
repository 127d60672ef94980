#pragma once

#include <cmath>
#include <numbers>

#include <pharos/config/schema.h>
#include <pharos/laboratory/integrand.h>

namespace pharos::laboratory {

/// smooth_disk: a disk with a border that is blurred along the radius. Its value is Phi((radius -
/// r) / width) at the distance r from the center, where Phi is the standard normal distribution
/// function. The disk and a margin of six widths lie within the square. Partial integration turns
/// the mean into second moments of a normal distribution: pi ((radius^2 + width^2) Phi(s) + radius
/// width phi(s)) with s = radius / width.
class SmoothDisk {
 public:
  struct Settings {
    Vec2 center{0.5f, 0.5f};
    double radius = 0.25;
    double width = 0.04;
    static void describe(Schema<Settings>& schema);
  };

  explicit SmoothDisk(const Settings& settings);

  double operator()(PlanePoint p) const {
    const double dx = p.x - center_.x, dy = p.y - center_.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    return 0.5 * std::erfc((distance - radius_) / (width_ * std::numbers::sqrt2));
  }
  double mean() const;

 private:
  PlanePoint center_;
  double radius_, width_;
};

}  // namespace pharos::laboratory

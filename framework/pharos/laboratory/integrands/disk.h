#pragma once

#include <pharos/config/schema.h>
#include <pharos/laboratory/integrand.h>

namespace pharos::laboratory {

/// disk: 1 inside, 0 outside. The mean is the area of the part of the disk in the square, computed
/// from the areas of its parts left of and below each corner of the square.
class Disk {
 public:
  struct Settings {
    Vec2 center{0.5f, 0.5f};
    double radius = 0.3;
    static void describe(Schema<Settings>& schema);
  };

  explicit Disk(const Settings& settings);

  double operator()(PlanePoint p) const {
    const double dx = p.x - center_.x, dy = p.y - center_.y;
    return dx * dx + dy * dy <= radius_ * radius_ ? 1 : 0;
  }
  double mean() const { return mean_; }

 private:
  PlanePoint center_;
  double radius_, mean_;
};

}  // namespace pharos::laboratory

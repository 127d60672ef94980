#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/laboratory/convex_region.h>

namespace pharos::laboratory {

/// textured: 1 + contrast cos(2 pi frequency . p) in the intersection of half planes, 0 outside.
/// The mean is the area of the clipped polygon plus contrast times the integral of the wave over
/// it.
class Textured {
 public:
  struct Settings {
    std::vector<double> angles{30};
    std::vector<double> offsets;
    Vec2 frequency{3, 5};
    double contrast = 0.8;
    static void describe(Schema<Settings>& schema);
  };

  explicit Textured(const Settings& settings)
      : region_(region_of(settings.angles, settings.offsets)),
        wave_{2 * std::numbers::pi * settings.frequency.x,
              2 * std::numbers::pi * settings.frequency.y},
        contrast_(settings.contrast) {
    required_area(region_, "the edges");
  }

  double operator()(PlanePoint p) const {
    if (!region_.contains(p)) return 0;
    return 1 + contrast_ * std::cos(wave_.x * p.x + wave_.y * p.y);
  }
  double mean() const {
    const std::vector<PlanePoint> polygon = region_.polygon_in_square();
    return area(polygon) + contrast_ * wave_integral(polygon, wave_);
  }

 private:
  ConvexRegion region_;
  PlanePoint wave_;
  double contrast_;
};

}  // namespace pharos::laboratory

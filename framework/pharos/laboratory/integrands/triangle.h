#pragma once

#include <vector>

#include <pharos/config/schema.h>
#include <pharos/laboratory/convex_region.h>

namespace pharos::laboratory {

/// triangle: 1 inside, 0 outside. The mean is the area of the part of the triangle in the square.
class Triangle {
 public:
  struct Settings {
    std::vector<Vec2> vertices{{0.15f, 0.2f}, {0.9f, 0.35f}, {0.4f, 0.85f}};
    static void describe(Schema<Settings>& schema);
  };

  explicit Triangle(const Settings& settings);

  double operator()(PlanePoint p) const { return region_.contains(p) ? 1 : 0; }
  double mean() const { return mean_; }

 private:
  ConvexRegion region_;
  double mean_;
};

}  // namespace pharos::laboratory

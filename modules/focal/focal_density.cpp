#include "focal_density.h"

#include <cmath>

namespace pharos::focal {

double FocalDensity::directional_density(Point3 from, Vec3 direction) const {
  const Line line(converging.box(), from, direction);
  DirectionalDensity<Side::ahead> ahead(converging, line);
  DirectionalDensity<Side::behind> behind(diverging, line);
  for (bool more_ahead = true, more_behind = true; more_ahead || more_behind;) {
    if (more_ahead) more_ahead = ahead.advance();
    if (more_behind) more_behind = behind.advance();
  }
  return ahead.value() + behind.value();
}

std::optional<Vec3> FocalDensity::sample_direction(Point3 from, float sign,
                                                   const Double3& u) const {
  const bool away = sign * (converging.mass() + diverging.mass()) >= converging.mass();
  const Double3 point = (away ? diverging : converging).sample(u);
  Double3 offset;
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    offset[axis] = point[axis] - from[axis];
    squared += offset[axis] * offset[axis];
  }
  if (!(squared > 0)) return std::nullopt;
  const double scale = (away ? -1 : 1) / std::sqrt(squared);
  return Vec3{static_cast<float>(scale * offset[0]), static_cast<float>(scale * offset[1]),
              static_cast<float>(scale * offset[2])};
}

}  // namespace pharos::focal

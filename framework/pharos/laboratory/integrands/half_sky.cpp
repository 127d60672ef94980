#include <array>
#include <cmath>
#include <numbers>

#include <pharos/core/warp.h>
#include <pharos/laboratory/integrands/half_sky.h>

namespace pharos {

template <>
struct EnumNames<laboratory::HemisphereMap> {
  using enum laboratory::HemisphereMap;
  static constexpr auto names = std::to_array<EnumName<laboratory::HemisphereMap>>(
      {{"polar", polar}, {"concentric", concentric}, {"octahedral", octahedral}});
};

}  // namespace pharos

namespace pharos::laboratory {
namespace {

Vec3 direction_at(HemisphereMap map, Vec2 u) {
  switch (map) {
    case HemisphereMap::polar:
      return warp::about_z(1 - std::sqrt(1 - u.x), u.y);
    case HemisphereMap::concentric:
      return warp::cosine_hemisphere_from_square(u);
    case HemisphereMap::octahedral:
      return warp::octahedral_hemisphere_from_square(u);
  }
  return {};
}

/// Returns cos / (pi p), where p is the density of the direction. It is 0 at the horizon.
double weight(HemisphereMap map, Vec3 direction) {
  if (map != HemisphereMap::octahedral) return 1;
  const float p = warp::octahedral_hemisphere_pdf(direction);
  return p > 0 ? direction.z / (std::numbers::pi * p) : 0;
}

}  // namespace

void HalfSky::Settings::describe(Schema<Settings>& s) {
  s.field("map", &Settings::map, "Map from the square to directions");
  s.field("azimuth", &Settings::azimuth,
          "Azimuth of the normal of the sky's edge, on the side of the sky")
      .unit("degrees");
  s.field("tilt", &Settings::tilt,
          "Angle between this normal and the surface normal; with 90, half of the sky is black")
      .unit("degrees")
      .at_least(0)
      .at_most(170);
}

HalfSky::HalfSky(const Settings& settings) : map_(settings.map) {
  const double tilt = settings.tilt * std::numbers::pi / 180;
  const double azimuth = settings.azimuth * std::numbers::pi / 180;
  inward_ = {static_cast<float>(std::sin(tilt) * std::cos(azimuth)),
             static_cast<float>(std::sin(tilt) * std::sin(azimuth)),
             static_cast<float>(std::cos(tilt))};
  mean_ = (1 + std::cos(tilt)) / 2;
}

double HalfSky::operator()(PlanePoint p) const {
  const Vec3 direction = direction_at(map_, {static_cast<float>(p.x), static_cast<float>(p.y)});
  return dot(direction, inward_) > 0 ? weight(map_, direction) : 0;
}

}  // namespace pharos::laboratory

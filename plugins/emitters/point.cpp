// point: light from a single point, with the same `intensity` [W/sr] in every direction. At
// distance r it produces the irradiance intensity / r^2 at normal incidence. A path cannot hit it
// by chance; only next event estimation finds it.
//
//     emitters: [ { type: point, intensity: [3, 1, 1], position: [0, 0, 2] } ]

#include "point.h"

#include <pharos/core/warp.h>
#include <pharos/scene/reach.h>

#include "local_light.h"

namespace pharos {
namespace {

class PointLight final : public Light {
 public:
  PointLight(Rgb intensity, Point3 position) : intensity_(intensity), position_(position) {}

  LightSample sample(Point3 from, Vec2) const override {
    return local_sample(position_, from, [this](Vec3) { return intensity_; });
  }

  EmissionSample sample_emission(Vec2, Vec2 u_direction) const override {
    return local_emission(position_, warp::sphere_from_square(u_direction), warp::sphere_pdf(),
                          intensity_);
  }
  EmissionDensity pdf_emission(const SurfacePoint&, Vec3) const override {
    return {1, warp::sphere_pdf()};
  }

  float power() const override { return 4 * kPi * mean(intensity_); }

 private:
  Rgb intensity_;
  Point3 position_;
};

}  // namespace

void PointEmitter::Settings::describe(Schema<Settings>& s) {
  s.field("intensity", &Settings::intensity, "Intensity in every direction")
      .unit("W/sr")
      .at_least(0);
  s.field("position", &Settings::position, "Position before to_world is applied")
      .unit("scene units");
  s.field("to_world", &Settings::to_world, "From local to world space");
  s.field("scale", &Settings::scale, "Factor on the intensity").at_least(0);
  s.example("{ intensity: [3, 1, 0.5], position: [0.2, -0.3, 2] }");
}

PointEmitter::PointEmitter(const Settings& settings)
    : intensity_(settings.scale * settings.intensity),
      position_(settings.to_world.point(settings.position)) {
  check_reach(position_, "the light");
}

std::unique_ptr<const Light> PointEmitter::place(const EmitterSite&) const {
  return std::make_unique<const PointLight>(intensity_, position_);
}

}  // namespace pharos

// constant: an environment that sends the same radiance from every direction. It is sampled
// uniformly over the sphere of directions (density 1/(4 pi) [1/sr]). It makes a closed white
// furnace in one line.
//
//     emitters: [ { type: constant, radiance: [0.5, 0.7, 1] } ]

#include "constant.h"

#include <pharos/core/warp.h>

#include "distant_light.h"

namespace pharos {
namespace {

class ConstantLight : public Light {
 public:
  ConstantLight(Rgb radiance, const EmitterSite& site) : radiance_(radiance), site_(site) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    return distant_sample(site_, from, warp::sphere_from_square(u), radiance_, warp::sphere_pdf());
  }

  bool is_environment() const override { return true; }
  float pdf_direction(Vec3) const override { return warp::sphere_pdf(); }
  Rgb environment_radiance(Vec3) const override { return radiance_; }

  EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const override {
    return distant_emission(site_, warp::sphere_from_square(u_direction), radiance_,
                            warp::sphere_pdf(), u_position);
  }
  EmissionDensity pdf_emission(const SurfacePoint&, Vec3 direction) const override {
    return {distant_position_pdf(site_), pdf_direction(-direction)};
  }

  float power() const override { return power_into_scene(site_, 4 * kPi * mean(radiance_)); }

 private:
  Rgb radiance_;
  EmitterSite site_;
};

}  // namespace

void ConstantEmitter::Settings::describe(Schema<Settings>& s) {
  s.field("radiance", &Settings::radiance, "Radiance from every direction")
      .unit("W/(m^2 sr)")
      .at_least(0);
  s.field("scale", &Settings::scale, "Factor on the radiance").at_least(0);
  s.example("{ radiance: [0.5, 0.7, 1], scale: 2 }");
}

std::unique_ptr<const Light> ConstantEmitter::place(const EmitterSite& site) const {
  return std::make_unique<const ConstantLight>(radiance_, site);
}

}  // namespace pharos

// directional: parallel light from infinitely far away, like sunlight without the sun's disk. It
// travels along `direction` and produces the irradiance `irradiance` [W/m^2] on surfaces at normal
// incidence. A path cannot hit it by chance; only next event estimation finds it.
//
//     emitters: [ { type: directional, irradiance: [1, 0.9, 0.8], direction: [1, 0, -2] } ]

#include "directional.h"

#include "distant_light.h"

namespace pharos {
namespace {

class DirectionalLight final : public Light {
 public:
  DirectionalLight(Rgb irradiance, Vec3 towards_light, const EmitterSite& site)
      : irradiance_(irradiance), towards_light_(towards_light), site_(site) {}

  LightSample sample(Point3 from, Vec2) const override {
    LightSample sample = distant_sample(site_, from, towards_light_, irradiance_, 1);
    sample.discrete = true;
    return sample;
  }

  EmissionSample sample_emission(Vec2 u_position, Vec2) const override {
    return distant_emission(site_, towards_light_, irradiance_, 1, u_position);
  }
  EmissionDensity pdf_emission(const SurfacePoint&, Vec3) const override {
    return {distant_position_pdf(site_), 1};
  }

  float power() const override { return power_into_scene(site_, mean(irradiance_)); }

 private:
  Rgb irradiance_;
  Vec3 towards_light_;
  EmitterSite site_;
};

}  // namespace

void DirectionalEmitter::Settings::describe(Schema<Settings>& s) {
  s.field("irradiance", &Settings::irradiance, "Irradiance at normal incidence")
      .unit("W/m^2")
      .at_least(0);
  s.field("direction", &Settings::direction,
          "Direction in which the light travels; any length except 0")
      .check("a direction",
             [](const Vec3& d) { return std::abs(length(normalize(d)) - 1) < 1e-3f; });
  s.field("scale", &Settings::scale, "Factor on the irradiance").at_least(0);
  s.example("{ irradiance: [1, 0.9, 0.8], direction: [1, -0.5, -2] }");
}

std::unique_ptr<const Light> DirectionalEmitter::place(const EmitterSite& site) const {
  return std::make_unique<const DirectionalLight>(irradiance_, towards_light_, site);
}

}  // namespace pharos

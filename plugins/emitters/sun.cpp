// sun: the sun's disk as seen from the ground, with uniform radiance. Its light is attenuated by
// Rayleigh scattering, aerosols, ozone and water vapor as in Preetham, Shirley and Smits 1999 ("A
// Practical Analytic Model for Daylight", appendix). The paper's tables from 380 to 750 nm, in
// steps of 10, are weighted by the CIE 1931 matching functions and converted to linear Rec.709. A
// `sky` of the same parameters is the rest of the daylight; sky.cpp describes the units, the sun's
// position and `stretch`. A sun below the horizon is an error.
//
// The disk is 0.5358 degrees wide, as in Mitsuba 0.6. `radius_scale` enlarges it, for softer
// shadows and less noise, or shrinks it; the irradiance stays the same. With 0 the sun is parallel
// light from a single direction, like `directional`. Directions are drawn uniformly from the disk's
// cone.
//
//     emitters:
//       - { type: sun, turbidity: 3, sun_direction: [1, 2, 1] }
//       - { type: sky, turbidity: 3, sun_direction: [1, 2, 1] }

#include "sun.h"

#include <cmath>

#include <pharos/core/warp.h>

#include "directional.h"
#include "distant_light.h"
#include "latlong_light.h"
#include "preetham.h"

namespace pharos {
namespace {

constexpr float kAngularRadius = 0.5f * 0.5358f;  // [degrees]

/// Returns 1 - cos of the disk's radius at `scale`, without losing digits.
float one_minus_cos(float scale) {
  const float sine = std::sin(0.5f * radians(kAngularRadius * scale));
  return 2 * sine * sine;
}

class SunLight final : public Light {
 public:
  SunLight(Vec3 towards_sun, Rgb irradiance, float one_minus_cos, const EmitterSite& site)
      : frame_(Frame::from_normal(towards_sun)),
        irradiance_(irradiance),
        one_minus_cos_(one_minus_cos),
        site_(site) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    const Vec3 direction = frame_.to_world(warp::cone_from_square(u, one_minus_cos_));
    return distant_sample(site_, from, direction, environment_radiance(direction),
                          pdf_direction(direction));
  }

  bool is_environment() const override { return true; }
  float pdf_direction(Vec3 direction) const override {
    // Uses the chord, whose square is 2 - 2 cos, because it keeps the digits of small angles.
    const Vec3 chord = direction - frame_.n;
    return dot(chord, chord) <= 2 * one_minus_cos_ ? warp::cone_pdf(one_minus_cos_) : 0.0f;
  }
  Rgb environment_radiance(Vec3 direction) const override {
    return pdf_direction(direction) * irradiance_;
  }

  EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const override {
    const Vec3 towards = frame_.to_world(warp::cone_from_square(u_direction, one_minus_cos_));
    return distant_emission(site_, towards, environment_radiance(towards), pdf_direction(towards),
                            u_position);
  }
  EmissionDensity pdf_emission(const SurfacePoint&, Vec3 direction) const override {
    return {distant_position_pdf(site_), pdf_direction(-direction)};
  }

  float power() const override { return power_into_scene(site_, mean(irradiance_)); }

 private:
  Frame frame_;
  Rgb irradiance_;
  float one_minus_cos_;
  EmitterSite site_;
};

}  // namespace

void SunEmitter::Settings::describe(Schema<Settings>& s) {
  describe_daylight(s);
  s.field("radius_scale", &Settings::radius_scale,
          "Factor on the disk's radius, 0 or at least 0.01; it does not change the irradiance")
      .at_most(100)
      .check("0 or at least 0.01", [](float scale) { return scale == 0 || scale >= 0.01f; });
  s.example("{ turbidity: 2, sun_direction: [1, 1, 0], radius_scale: 20 }");
  s.example(
      "{ turbidity: 6, sun_direction: [1, 0, 0.1], stretch: 1.2, radius_scale: 50, scale: 3, "
      "to_world: { rotate: { axis: [1, 0, 0], degrees: 90 } } }");
  s.example("{ radius_scale: 0 }");
}

SunEmitter::SunEmitter(const Settings& settings)
    : one_minus_cos_(one_minus_cos(settings.radius_scale)) {
  const Frame axes = turned_axes(settings.to_world, "sun");
  const SunPlace sun = sun_place(settings, axes, "sun");
  towards_sun_ = normalize(axes.to_world(sun.direction(sun.zenith * settings.stretch)));
  const float solid_angle = 2 * kPi * one_minus_cos(1);
  irradiance_ =
      settings.scale * solid_angle * preetham_sun_radiance(settings.turbidity, sun.zenith);
}

std::unique_ptr<const Light> SunEmitter::place(const EmitterSite& site) const {
  if (one_minus_cos_ > 0) {
    return std::make_unique<const SunLight>(towards_sun_, irradiance_, one_minus_cos_, site);
  }
  return DirectionalEmitter({.irradiance = irradiance_, .direction = -towards_sun_}).place(site);
}

}  // namespace pharos

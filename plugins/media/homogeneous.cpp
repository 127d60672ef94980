// homogeneous: a medium that is the same everywhere, such as fog, smoke or colored water. Per scene
// unit along a ray the share `scattering` of the light is scattered and the share `absorption` is
// absorbed. Both may be colors, and both are multiplied by `scale`. After a distance t the share
// exp(-(scattering + absorption) t) is left.
//
// Distances are drawn for one channel, which is chosen in proportion to the path's throughput in
// each channel. They are weighted by the mean density over all channels (multiple importance
// sampling, balance heuristic). Pure scattering therefore keeps the sum of a path's channels, even
// if the channels scatter differently. Media that only absorb let every ray pass.
//
//     media:
//       haze: { type: homogeneous, scattering: 0.2, absorption: [0, 0.01, 0.02],
//               phase: { type: henyey_greenstein, g: 0.8 } }

#include "homogeneous.h"

#include <cmath>

namespace pharos {
namespace {

/// Returns exp(-coefficient t); 1 for a coefficient of 0, even at infinity.
float left_after(float coefficient, float t) {
  return coefficient > 0 ? std::exp(-coefficient * t) : 1.0f;
}

}  // namespace

void HomogeneousMedium::Settings::describe(Schema<Settings>& s) {
  s.field("scattering", &Settings::scattering, "Scattering coefficient").unit("1/m").at_least(0);
  s.field("absorption", &Settings::absorption, "Absorption coefficient").unit("1/m").at_least(0);
  s.field("scale", &Settings::scale, "Factor on both coefficients").at_least(0);
  s.field("phase", &Settings::phase, "Phase function: the distribution of scattered directions")
      .otherwise("isotropic");
  s.example("{ scattering: 0.7, phase: { type: henyey_greenstein, g: 0.5 } }");
  s.example("{ scattering: [2, 0.5, 0], absorption: [0, 0.5, 3], scale: 0.5 }");
  s.example("{ scattering: 0, absorption: [0.1, 1, 2] }");
}

HomogeneousMedium::HomogeneousMedium(const Settings& settings)
    : scattering_(settings.scale * settings.scattering),
      extinction_(settings.scale * (settings.scattering + settings.absorption)),
      phase_(settings.phase) {}

DistanceSample HomogeneousMedium::sample(const Ray& ray, Rgb shares, float u_channel,
                                         float u_distance) const {
  if (!scatters()) return {};
  const int channel = u_channel < shares.r ? 0 : u_channel < shares.r + shares.g ? 1 : 2;
  if (extinction_[channel] == 0) return {};
  const float t = -std::log1p(-u_distance) / extinction_[channel];
  return {t, t < ray.t_max};
}

MediumLeg HomogeneousMedium::leg(const Ray&, Rgb shares, float t) const {
  MediumLeg result{.transmittance = {left_after(extinction_.r, t), left_after(extinction_.g, t),
                                     left_after(extinction_.b, t)}};
  if (!scatters()) return result;
  const Rgb left = shares * result.transmittance;
  result.pass_probability = left.r + left.g + left.b;
  result.scatter_pdf = left.r * extinction_.r + left.g * extinction_.g + left.b * extinction_.b;
  return result;
}

}  // namespace pharos

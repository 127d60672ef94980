// rough_diffuse: plaster, sand or clay, as a surface of V-shaped grooves with matt facets (Oren and
// Nayar 1994, "Generalization of Lambert's Reflectance Model"). Let a and b be the larger and the
// smaller angle of o and i to the normal, p the azimuth between them, s the standard deviation of
// the facets' slope angles and r the facets' reflectance. Then
//
//     f = r / pi (C1 + cos(p) C2 tan(b) + (1 - |cos(p)|) C3 tan((a + b) / 2))
//         + 0.17 r^2 / pi s^2 / (s^2 + 0.13) (1 - cos(p) (2 b / pi)^2).
//
// The second line is light that two facets have reflected. `use_fast_approx` selects the
// qualitative model of the same paper, f = r / pi (A + B max(0, cos(p)) sin(a) tan(b)), which omits
// this light and is darker. `alpha` is the roughness of microfacets, their root mean square slope.
// It gives s = alpha / sqrt(2), as in Mitsuba; at 0 the surface is `diffuse`. If `alpha` is a
// color, the mean of its channels counts. sample() follows the cosine law, or `warp` as in
// `diffuse`.
//
// The formulas are fits. A white surface seen at a grazing angle reflects up to 4% more light than
// arrives; with a reflectance of at most 0.95 it does not. Only the side of the shading normal
// scatters light; the other side is black.
//
//     { type: rough_diffuse, reflectance: [0.6, 0.5, 0.4], alpha: 0.4 }
#include "rough_diffuse.h"

#include <cmath>

#include <pharos/config/registry.h>

#include "parameters.h"

namespace pharos {
namespace {

/// Two directions with z > 0, in the terms of the model. `a` is the angle of the direction farther
/// from the normal. Terms that are unbounded at grazing angles are multiplied by cos(i), which
/// bounds them.
struct Grooves {
  Grooves(Vec3 wo, Vec3 wi) : cos_i(wi.z) {
    const float sin_o = std::hypot(wo.x, wo.y), sin_i = std::hypot(wi.x, wi.y);
    const float cos_b = std::max(wo.z, wi.z), sin_b = std::min(sin_o, sin_i);
    sin_a = std::max(sin_o, sin_i);
    a = std::atan2(sin_a, std::min(wo.z, wi.z));
    b = std::atan2(sin_b, cos_b);
    if (sin_b > 0) cos_azimuth = std::clamp((wo.x * wi.x + wo.y * wi.y) / sin_o / sin_i, -1.f, 1.f);
    cos_tan_b = sin_b * (cos_i / cos_b);
    cos_tan_mean = (sin_a + sin_b) * (cos_i / (wo.z + wi.z));
  }

  float cos_i;            ///< cosine of the scattered direction
  float a, b;             ///< angles to the normal [rad]
  float sin_a;            ///< sine of the larger angle
  float cos_azimuth = 0;  ///< cosine of the azimuth between the directions; 0 if undefined
  float cos_tan_b;        ///< cos(i) tan(b)
  float cos_tan_mean;     ///< cos(i) tan((a + b) / 2)
};

/// f cos(i) pi of light reflected once, divided by the reflectance, and of light reflected twice,
/// divided by its square.
struct Orders {
  float once, twice;
};

Orders full_model(const Grooves& g, float sigma_squared) {
  const float steep = sigma_squared / (sigma_squared + 0.09f);
  const float lean = 2 * g.b / kPi;
  const float c1 = 1 - 0.5f * sigma_squared / (sigma_squared + 0.33f);
  const float c2 = 0.45f * steep * (g.sin_a - (g.cos_azimuth >= 0 ? 0 : lean * lean * lean));
  const float c3 = 0.125f * steep * square(4 * g.a * g.b / (kPi * kPi));
  const float twice = 0.17f * sigma_squared / (sigma_squared + 0.13f);
  return {c1 * g.cos_i + g.cos_azimuth * c2 * g.cos_tan_b +
              (1 - std::abs(g.cos_azimuth)) * c3 * g.cos_tan_mean,
          twice * (1 - g.cos_azimuth * lean * lean) * g.cos_i};
}

Orders qualitative_model(const Grooves& g, float sigma_squared) {
  const float a = 1 - 0.5f * sigma_squared / (sigma_squared + 0.33f);
  const float b = 0.45f * sigma_squared / (sigma_squared + 0.09f);
  return {a * g.cos_i + b * std::max(0.0f, g.cos_azimuth) * g.sin_a * g.cos_tan_b, 0};
}

}  // namespace

void RoughDiffuse::Settings::describe(Schema<Settings>& s) {
  describe_share(s, "reflectance", &Settings::reflectance, "Share of light that a facet reflects",
                 "0.5");
  describe_share(s, "alpha", &Settings::alpha, "Root mean square slope of the facets", "0.2");
  s.field("use_fast_approx", &Settings::use_fast_approx,
          "Whether to use the qualitative model of Oren and Nayar");
  describe_warp(s);
  s.example("{ reflectance: [0.9, 0.5, 0.2], alpha: 0.5 }");
  s.example("{ reflectance: 0.95, alpha: 0.3 }");
  s.example("{ reflectance: 0.8, alpha: 1, use_fast_approx: true }");
}

ScatterValue RoughDiffuse::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                    ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const float sigma_squared = 0.5f * square(mean(settings_.alpha->evaluate(point)));
  const Grooves grooves(wo, wi);
  const Orders orders = settings_.use_fast_approx ? qualitative_model(grooves, sigma_squared)
                                                  : full_model(grooves, sigma_squared);
  const Rgb facet = settings_.reflectance->evaluate(point);
  return {(Rgb(orders.once) + orders.twice * facet) * facet / kPi,
          hemisphere_pdf(settings_.warp, wi)};
}

std::optional<ScatterSample> RoughDiffuse::sample(const SurfacePoint& point, Vec3 wo, float, Vec2 u,
                                                  ScatterOptions options) const {
  const Vec3 wi = hemisphere_from_square(settings_.warp, u);
  const ScatterValue value = evaluate(point, wo, wi, options);
  if (value.pdf == 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, value.value / value.pdf, value.pdf};
}

}  // namespace pharos

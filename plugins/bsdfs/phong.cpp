// phong: a matt surface with a glossy lobe about the mirror direction m of o, the reciprocal form
// of Phong's model (Lafortune and Willems 1994, "Using the Modified Phong Reflectance Model for
// Physically Based Rendering"):
//
//     f = diffuse / pi + specular (n + 2) / (2 pi) max(0, i.m)^n.
//
// The lobe reflects its share at normal incidence and less elsewhere. So no more light leaves than
// arrives if both shares add up to at most 1. The check adds the largest values of both textures in
// each channel and rejects a larger sum. If `rescale_to` is given, both shares are instead
// multiplied by one factor, so that the largest sum equals `rescale_to` (Mitsuba 0.6 uses 0.99).
//
// sample() chooses between cosine law and lobe by the means of their channels. Directions drawn
// below the surface are samples of value zero. If the exponent is a color, the mean of its channels
// counts. Only the side of the shading normal scatters light; the other side is black.
//
//     type: phong
//     diffuse_reflectance: [0.5, 0.1, 0.1]
//     specular_reflectance: 0.3
//     exponent: 80
#include "phong.h"

#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "parameters.h"

namespace pharos {
namespace {

constexpr float kLargestExponent = 1e5f;

/// Returns max(0, cosine)^n / (2 pi) for the cosine between `w` and `axis`. It starts from the
/// distance of both vectors, because their cosine has lost the digits that large exponents need.
float lobe_density(Vec3 axis, Vec3 w, float exponent) {
  const float one_minus_cosine = 0.5f * length_squared(w - axis);
  if (one_minus_cosine >= 1) return 0;
  return std::exp(exponent * std::log1p(-one_minus_cosine)) / (2 * kPi);
}

/// Draws a direction about `axis` with the density (n + 1) lobe_density() [1/sr].
Vec3 sample_lobe(Vec3 axis, float exponent, Vec2 u) {
  const float one_minus_cosine = -std::expm1(std::log1p(-u.x) / (exponent + 1));
  const float sine = safe_sqrt(one_minus_cosine * (2 - one_minus_cosine)), phi = 2 * kPi * u.y;
  const Vec3 w{sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cosine};
  return normalize(Frame::from_normal(axis).to_world(w));
}

}  // namespace

void Phong::Settings::describe(Schema<Settings>& s) {
  describe_share(s, "diffuse_reflectance", &Settings::diffuse_reflectance,
                 "Share of light reflected by the cosine law", "0.5");
  describe_share(s, "specular_reflectance", &Settings::specular_reflectance,
                 "Share of light in the lobe at normal incidence", "0.2");
  s.field("exponent", &Settings::exponent,
          "Exponent of the lobe's cosine: 0 is wide, 1000 is narrow")
      .otherwise("30")
      .check("in [0, 1e5] everywhere",
             [](const Ref<Texture>& t) { return max_component(t->maximum()) <= kLargestExponent; });
  s.field("rescale_to", &Settings::rescale_to,
          "Limit for the sum of both reflectances; a larger sum is scaled down to it")
      .above(0)
      .at_most(1);
  s.example("{ diffuse_reflectance: 0, specular_reflectance: [0.9, 0.5, 0.2], exponent: 0 }");
  s.example("{ diffuse_reflectance: [0.1, 0.2, 0.5], specular_reflectance: 0.5, exponent: 1000 }");
  s.example("{ diffuse_reflectance: 0.9, specular_reflectance: 0.8, rescale_to: 0.99 }");
}

Phong::Phong(const Settings& settings) : settings_(settings) {
  if (!settings.rescale_to) {
    check_sum(*settings.diffuse_reflectance, *settings.specular_reflectance,
              "diffuse_reflectance and specular_reflectance, without rescale_to,");
    return;
  }
  const float sum = max_component(settings.diffuse_reflectance->maximum() +
                                  settings.specular_reflectance->maximum());
  if (sum > *settings.rescale_to) scale_ = *settings.rescale_to / sum;
}

Phong::Lobes Phong::lobes(const SurfacePoint& point) const {
  const Rgb diffuse = scale_ * settings_.diffuse_reflectance->evaluate(point);
  const Rgb specular = scale_ * settings_.specular_reflectance->evaluate(point);
  return {diffuse,
          specular,
          mean(settings_.exponent->evaluate(point)),
          {mean(specular), mean(diffuse)}};
}

ScatterValue Phong::scattered(const Lobes& lobes, Vec3 wo, Vec3 wi) {
  if (wi.z <= 0) return {};
  const float lobe = lobe_density({-wo.x, -wo.y, wo.z}, wi, lobes.exponent);
  const float matt = warp::cosine_hemisphere_pdf(wi.z);
  return {matt * lobes.diffuse + (lobes.exponent + 2) * lobe * wi.z * lobes.specular,
          lobes.choice.first() * (lobes.exponent + 1) * lobe + lobes.choice.second() * matt};
}

ScatterValue Phong::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                             ScatterOptions options) const {
  if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  return scattered(lobes(point), wo, wi);
}

std::optional<ScatterSample> Phong::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                           Vec2 u, ScatterOptions options) const {
  if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const Lobes all = lobes(point);
  if (all.choice.nothing()) return {};
  const Vec3 wi = all.choice.takes_first(u_choice)
                      ? sample_lobe({-wo.x, -wo.y, wo.z}, all.exponent, u)
                      : warp::cosine_hemisphere_from_square(u);
  const ScatterValue value = scattered(all, wo, wi);
  if (value.pdf == 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, value.value / value.pdf, value.pdf};
}

/// The GGX alpha of a lobe with about the same width (Walter et al. 2007).
float Phong::roughness(const SurfacePoint& point) const {
  const Lobes all = lobes(point);
  return is_black(all.specular) ? 1 : std::sqrt(2 / (all.exponent + 2));
}

Rgb Phong::albedo(const SurfacePoint& point) const {
  const Lobes all = lobes(point);
  return all.diffuse + all.specular;
}

}  // namespace pharos

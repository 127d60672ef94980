// diffuse: an ideally matt surface, f = reflectance / pi (Lambert 1760). Only the side of the
// shading normal scatters light; the other side is black. Samples are drawn in proportion to the
// cosine, so that all have equal weight. `warp: octahedral` draws them by a map that keeps straight
// edges straight (Engelhardt and Dachsbacher 2008), for samplers that align with such edges.
//
//     { type: diffuse, reflectance: [0.7, 0.3, 0.2] }
#include "diffuse.h"

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "parameters.h"

namespace pharos {

void Diffuse::Settings::describe(Schema<Settings>& s) {
  describe_share(s, "reflectance", &Settings::reflectance, "Share of light that is reflected",
                 "0.5");
  describe_warp(s);
}

ScatterValue Diffuse::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                               ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  return {warp::cosine_hemisphere_pdf(wi.z) * settings_.reflectance->evaluate(point),
          hemisphere_pdf(settings_.warp, wi)};
}

std::optional<ScatterSample> Diffuse::sample(const SurfacePoint& point, Vec3 wo, float, Vec2 u,
                                             ScatterOptions options) const {
  if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const Vec3 wi = hemisphere_from_square(settings_.warp, u);
  if (wi.z <= 0) return {};
  const float pdf = hemisphere_pdf(settings_.warp, wi);
  return ScatterSample{
      wi, Event::smooth_reflect,
      (warp::cosine_hemisphere_pdf(wi.z) / pdf) * settings_.reflectance->evaluate(point), pdf};
}

}  // namespace pharos

// diffuse: an ideally matt surface, f = reflectance / pi (Lambert 1760). Light is scattered on the
// side of the shading normal only; the other side is black.
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
}

ScatterValue Diffuse::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                               ScatterOptions options) const {
  if (wo.z <= 0 || wi.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const float pdf = warp::cosine_hemisphere_pdf(wi.z);
  return {pdf * reflectance_->evaluate(point), pdf};
}

std::optional<ScatterSample> Diffuse::sample(const SurfacePoint& point, Vec3 wo, float, Vec2 u,
                                             ScatterOptions options) const {
  if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
  const Vec3 wi = warp::cosine_hemisphere_from_square(u);
  if (wi.z <= 0) return {};
  return ScatterSample{wi, Event::smooth_reflect, reflectance_->evaluate(point),
                       warp::cosine_hemisphere_pdf(wi.z)};
}

}  // namespace pharos

#include "tilted_bsdf.h"

#include <algorithm>
#include <cmath>

namespace pharos {
namespace {

/// Normals with a smaller cosine to the surface's normal are lifted to this cosine.
constexpr float kLeastCosine = 1e-3f;

Vec3 to_world(const Frame& frame, Vec3 local) {
  return normalize(frame.to_world(local));
}

/// The factor of the tilt on light scattered from `wo` into `wi`; `o` and `i` are the same
/// directions in the tilted frame. See TiltedBsdf.
float tilt_factor(Vec3 wo, Vec3 o, Vec3 wi, Vec3 i, Transport transport) {
  if (!(wo.z * o.z > 0 && wi.z * i.z > 0)) return 0;
  if (transport == Transport::radiance) return 1;
  return std::abs(o.z) * std::abs(wi.z) / (std::abs(wo.z) * std::abs(i.z));
}

}  // namespace

std::optional<TiltedBsdf::Tilt> TiltedBsdf::tilt(const SurfacePoint& point) const {
  Vec3 n = normal(point);
  const float size = length(n);
  if (!(size > 0) || !std::isfinite(size) || (n.x == 0 && n.y == 0)) return {};
  n.z = std::max(n.z, kLeastCosine * size);
  n = normalize(n);
  const Vec3 s = normalize(Vec3{n.z, 0, -n.x});  // above x, like dp/du of the displaced surface
  const Frame frame{s, cross(n, s), n};
  Tilt result{frame, point};
  const Frame& own = point.shading;
  result.point.shading = {to_world(own, frame.s), to_world(own, frame.t), to_world(own, frame.n)};
  return result;
}

ScatterValue TiltedBsdf::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                  ScatterOptions options) const {
  const std::optional<Tilt> tilted = tilt(point);
  if (!tilted) return bsdf_->evaluate(point, wo, wi, options);
  const Vec3 o = tilted->frame.to_local(wo), i = tilted->frame.to_local(wi);
  const float factor = tilt_factor(wo, o, wi, i, options.transport);
  if (factor == 0) return {};
  ScatterValue result = bsdf_->evaluate(tilted->point, o, i, options);
  result.value *= factor;
  return is_finite(result.value) ? result : ScatterValue{};
}

std::optional<ScatterSample> TiltedBsdf::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                                Vec2 u, ScatterOptions options) const {
  const std::optional<Tilt> tilted = tilt(point);
  if (!tilted) return bsdf_->sample(point, wo, u_choice, u, options);
  const Vec3 o = tilted->frame.to_local(wo);
  std::optional<ScatterSample> result = bsdf_->sample(tilted->point, o, u_choice, u, options);
  if (!result) return {};
  if (result->event == Event::pass_through) {
    result->direction = -wo;
    return result;
  }
  const Vec3 i = result->direction;
  result->direction = tilted->frame.to_world(i);
  const float factor = tilt_factor(wo, o, result->direction, i, options.transport);
  result->weight *= factor;
  if (factor == 0 || !is_finite(result->weight)) return {};
  return result;
}

DiscreteOutcomes TiltedBsdf::discrete(const SurfacePoint& point, Vec3 wo,
                                      ScatterOptions options) const {
  const std::optional<Tilt> tilted = tilt(point);
  if (!tilted) return bsdf_->discrete(point, wo, options);
  const Vec3 o = tilted->frame.to_local(wo);
  DiscreteOutcomes all;
  for (DiscreteOutcome outcome : bsdf_->discrete(tilted->point, o, options)) {
    const Vec3 i = outcome.direction;
    const bool straight = outcome.event == Event::pass_through;
    outcome.direction = straight ? -wo : tilted->frame.to_world(i);
    const float factor = straight ? 1 : tilt_factor(wo, o, outcome.direction, i, options.transport);
    outcome.value *= factor;
    if (factor != 0 && is_finite(outcome.value)) all.add(outcome);
  }
  return all;
}

}  // namespace pharos

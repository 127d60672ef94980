#include <pharos/scene/local_scattering.h>

namespace pharos {

float LocalScattering::normal_factor(Vec3 direction, Vec3 local) const {
  if (!sides_agree(direction, local) || !sides_agree(wo_, wo_local_)) return 0;
  if (transport_ == Transport::radiance) return 1;
  return std::abs(wo_local_.z) * abs_dot(direction, point_->normal) /
         (abs_dot(wo_, point_->normal) * std::abs(local.z));
}

ScatterValue LocalScattering::evaluate(Vec3 direction, EventMask allowed) const {
  if (!is_surface()) {
    if (!contains(allowed, Event::scatter)) return {};
    const float pdf = phase_->evaluate(wo_, direction);
    return {pdf * sigma_s_, pdf};
  }
  const Vec3 local = point_->shading.to_local(direction);
  const float factor = normal_factor(direction, local);
  if (factor == 0) return {};
  ScatterValue result = bsdf_->evaluate(*point_, wo_local_, local, {transport_, allowed});
  result.value *= factor;
  return result;
}

std::optional<ScatterSample> LocalScattering::sample(float u_choice, Vec2 u,
                                                     EventMask allowed) const {
  if (!is_surface()) {
    if (!contains(allowed, Event::scatter)) return std::nullopt;
    const Vec3 direction = phase_->sample(wo_, u);
    return ScatterSample{.direction = direction,
                         .event = Event::scatter,
                         .weight = sigma_s_,
                         .pdf = phase_->evaluate(wo_, direction)};
  }
  std::optional<ScatterSample> result =
      bsdf_->sample(*point_, wo_local_, u_choice, u, {transport_, allowed});
  if (!result) return std::nullopt;
  const Vec3 local = result->direction;
  result->direction = point_->shading.to_world(local);
  if (result->event == Event::pass_through) return result;
  const float factor = normal_factor(result->direction, local);
  if (factor == 0) return std::nullopt;
  result->weight *= factor;
  return result;
}

DiscreteOutcomes LocalScattering::discrete(EventMask allowed) const {
  if (!is_surface()) return {};
  DiscreteOutcomes result;
  for (DiscreteOutcome outcome : bsdf_->discrete(*point_, wo_local_, {transport_, allowed})) {
    const Vec3 local = outcome.direction;
    outcome.direction = point_->shading.to_world(local);
    const bool straight = outcome.event == Event::pass_through;
    const float factor = straight ? 1 : normal_factor(outcome.direction, local);
    if (factor == 0) continue;
    outcome.value *= factor;
    result.add(outcome);
  }
  return result;
}

Event LocalScattering::smooth_event(Vec3 direction) const {
  if (!is_surface()) return Event::scatter;
  const bool same_side = dot(wo_, point_->normal) * dot(direction, point_->normal) > 0;
  return same_side ? Event::smooth_reflect : Event::smooth_transmit;
}

}  // namespace pharos

#pragma once

#include <cmath>
#include <optional>

#include <pharos/scene/bsdf.h>
#include <pharos/scene/medium.h>

namespace pharos {

/// The scattering at one path vertex in world space, either by a BSDF or by a phase function.
/// Directions point away from the vertex. A surface scatters nothing from or into a direction that
/// lies above the surface by one of the geometric and the shading normal and below it by the other.
/// Events that pass straight through are the exception. Importance transport includes Veach's
/// correction for shading normals (1997, eq. 5.19).
class LocalScattering {
 public:
  /// At a surface point. `towards_previous` is the unit direction to the previous path vertex.
  LocalScattering(const SurfacePoint& point, const Bsdf& bsdf, Vec3 towards_previous,
                  Transport transport)
      : LocalScattering(point, bsdf, bsdf.events(), towards_previous, transport) {}
  /// The same, for a caller that already knows Bsdf::events().
  LocalScattering(const SurfacePoint& point, const Bsdf& bsdf, EventMask events,
                  Vec3 towards_previous, Transport transport)
      : point_(&point),
        bsdf_(&bsdf),
        wo_(towards_previous),
        wo_local_(point.shading.to_local(towards_previous)),
        transport_(transport),
        events_(events) {}

  /// At a volume point with scattering coefficient `sigma_s` [1/m].
  LocalScattering(const PhaseFunction& phase, Rgb sigma_s, Vec3 towards_previous,
                  Transport transport)
      : phase_(&phase),
        sigma_s_(sigma_s),
        wo_(towards_previous),
        transport_(transport),
        events_(mask_of(Event::scatter)) {}

  bool is_surface() const { return bsdf_ != nullptr; }
  /// The surface point. Surfaces only.
  const SurfacePoint& surface() const { return *point_; }
  const Bsdf& bsdf() const { return *bsdf_; }
  Vec3 towards_previous() const { return wo_; }
  Transport transport() const { return transport_; }

  /// All events that are possible here.
  EventMask events() const { return events_; }
  bool purely_discrete() const { return is_empty(events() & EventMask::smooth); }
  /// The smallest roughness (GGX alpha) at surfaces; 1 - |mean cosine| in media.
  float roughness() const {
    return is_surface() ? bsdf_->roughness(*point_) : 1 - std::abs(phase_->mean_cosine());
  }

  /// Returns the value and the density [1/sr] of the smooth events among `allowed`. Both are zero
  /// if nothing is scattered into `direction`.
  ScatterValue evaluate(Vec3 direction, EventMask allowed = EventMask::all) const;
  /// Draws an event among `allowed`. Returns nothing for a valid sample of value zero.
  std::optional<ScatterSample> sample(float u_choice, Vec2 u,
                                      EventMask allowed = EventMask::all) const;
  /// Returns the discrete events among `allowed` that scatter any light.
  DiscreteOutcomes discrete(EventMask allowed = EventMask::all) const;
  /// Returns the smooth event of scattering into `direction`. At surfaces it depends on the sides
  /// of the two directions.
  Event smooth_event(Vec3 direction) const;

 private:
  bool sides_agree(Vec3 direction, Vec3 local) const {
    return dot(direction, point_->normal) * local.z > 0;
  }
  std::optional<ScatterSample> sample_phase(Vec2 u, EventMask allowed) const;
  /// The factor by which shading normals scale light scattered into `direction` at surfaces. It is
  /// 0 if the sides disagree. Otherwise it is 1 for radiance and Veach's correction for importance.
  float normal_factor(Vec3 direction, Vec3 local) const;

  const SurfacePoint* point_ = nullptr;
  const Bsdf* bsdf_ = nullptr;
  const PhaseFunction* phase_ = nullptr;
  Rgb sigma_s_;
  Vec3 wo_;
  Vec3 wo_local_;
  Transport transport_;
  EventMask events_;
};

// Every vertex of every path calls these functions. They are inline, so that only the BSDF's own
// call is virtual.

inline float LocalScattering::normal_factor(Vec3 direction, Vec3 local) const {
  if (!sides_agree(direction, local) || !sides_agree(wo_, wo_local_)) return 0;
  if (transport_ == Transport::radiance) return 1;
  return std::abs(wo_local_.z) * abs_dot(direction, point_->normal) /
         (abs_dot(wo_, point_->normal) * std::abs(local.z));
}

inline ScatterValue LocalScattering::evaluate(Vec3 direction, EventMask allowed) const {
  if (!is_surface()) {
    if (!contains(allowed, Event::scatter)) return {};
    const float pdf = phase_->evaluate(wo_, direction);
    return {pdf * sigma_s_, pdf};
  }
  const Vec3 local = point_->shading.to_local(direction);
  const float factor = normal_factor(direction, local);
  if (factor == 0) return {};
  const ScatterValue own = bsdf_->evaluate(*point_, wo_local_, local, {transport_, allowed});
  return {factor * own.value, own.pdf};
}

inline std::optional<ScatterSample> LocalScattering::sample(float u_choice, Vec2 u,
                                                            EventMask allowed) const {
  // One variable is returned everywhere, so that it is never copied. A copy would stall the walks,
  // because it reads at once what was written in parts.
  std::optional<ScatterSample> result =
      is_surface() ? bsdf_->sample(*point_, wo_local_, u_choice, u, {transport_, allowed})
                   : sample_phase(u, allowed);
  if (!result || !is_surface()) return result;
  const Vec3 local = result->direction;
  result->direction = point_->shading.to_world(local);
  if (result->event == Event::pass_through) return result;
  const float factor = normal_factor(result->direction, local);
  if (factor == 0) {
    result.reset();
  } else {
    result->weight *= factor;
  }
  return result;
}

inline std::optional<ScatterSample> LocalScattering::sample_phase(Vec2 u, EventMask allowed) const {
  if (!contains(allowed, Event::scatter)) return std::nullopt;
  const Vec3 direction = phase_->sample(wo_, u);
  return ScatterSample{.direction = direction,
                       .event = Event::scatter,
                       .weight = sigma_s_,
                       .pdf = phase_->evaluate(wo_, direction)};
}

inline DiscreteOutcomes LocalScattering::discrete(EventMask allowed) const {
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

inline Event LocalScattering::smooth_event(Vec3 direction) const {
  if (!is_surface()) return Event::scatter;
  const bool same_side = dot(wo_, point_->normal) * dot(direction, point_->normal) > 0;
  return same_side ? Event::smooth_reflect : Event::smooth_transmit;
}

}  // namespace pharos

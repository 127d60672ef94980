#pragma once

#include <cmath>
#include <optional>

#include <pharos/scene/bsdf.h>
#include <pharos/scene/medium.h>

namespace pharos {

/// The scattering at one path vertex, BSDF or phase function alike, in world space. Directions
/// point away from the vertex. Surfaces scatter nothing from or into directions that lie on
/// different sides of the geometric and the shading normal, but for events that pass straight
/// through; importance transport carries Veach's correction for shading normals (1997, eq. 5.19).
class LocalScattering {
 public:
  /// At a surface point; `towards_previous` is the unit direction to where the path came from.
  LocalScattering(const SurfacePoint& point, const Bsdf& bsdf, Vec3 towards_previous,
                  Transport transport)
      : point_(&point),
        bsdf_(&bsdf),
        wo_(towards_previous),
        wo_local_(point.shading.to_local(towards_previous)),
        transport_(transport) {}

  /// At a volume point with scattering coefficient `sigma_s` [1/m].
  LocalScattering(const PhaseFunction& phase, Rgb sigma_s, Vec3 towards_previous,
                  Transport transport)
      : phase_(&phase), sigma_s_(sigma_s), wo_(towards_previous), transport_(transport) {}

  bool is_surface() const { return bsdf_ != nullptr; }
  /// The surface point; surfaces only.
  const SurfacePoint& surface() const { return *point_; }
  const Bsdf& bsdf() const { return *bsdf_; }
  Vec3 towards_previous() const { return wo_; }
  Transport transport() const { return transport_; }

  /// All events possible here.
  EventMask events() const { return is_surface() ? bsdf_->events() : mask_of(Event::scatter); }
  bool purely_discrete() const { return is_empty(events() & EventMask::smooth); }
  /// Smallest roughness (GGX alpha) at surfaces; 1 - |mean cosine| in media.
  float roughness() const {
    return is_surface() ? bsdf_->roughness(*point_) : 1 - std::abs(phase_->mean_cosine());
  }

  /// Value and density [1/sr] of the smooth events among `allowed`; both are zero for directions
  /// into which nothing is scattered.
  ScatterValue evaluate(Vec3 direction, EventMask allowed = EventMask::all) const;
  /// Draws an event among `allowed`; empty for a valid sample of value zero.
  std::optional<ScatterSample> sample(float u_choice, Vec2 u,
                                      EventMask allowed = EventMask::all) const;
  /// The discrete events among `allowed` that scatter anything.
  DiscreteOutcomes discrete(EventMask allowed = EventMask::all) const;
  /// The event that scattering into `direction` is: by side at surfaces.
  Event smooth_event(Vec3 direction) const;

 private:
  bool sides_agree(Vec3 direction, Vec3 local) const {
    return dot(direction, point_->normal) * local.z > 0;
  }
  /// What shading normals make of light scattered into `direction`, at surfaces: 0 where sides
  /// disagree, else 1 for radiance and the correction for importance.
  float normal_factor(Vec3 direction, Vec3 local) const;

  const SurfacePoint* point_ = nullptr;
  const Bsdf* bsdf_ = nullptr;
  const PhaseFunction* phase_ = nullptr;
  Rgb sigma_s_;
  Vec3 wo_;
  Vec3 wo_local_;
  Transport transport_;
};

}  // namespace pharos

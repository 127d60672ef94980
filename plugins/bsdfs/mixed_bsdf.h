#pragma once

#include <array>

#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "lobe_choice.h"

namespace pharos {

/// The linear mix (1 - w) first + w second of two BSDFs, for each channel of a texture w in [0, 1].
///
/// sample() chooses by the mean of w's channels among those of the two that have events of the
/// kinds that are allowed, so densities are mixtures of their conditional densities. A direction
/// that both scatter into gets value and density of the whole. Discrete events of one kind add up
/// to one outcome; so both must send them the same way (reflections always go to the mirror
/// direction, and what passes through goes straight on; for refraction see `blend`).
class MixedBsdf : public Bsdf {
 public:
  MixedBsdf(Ref<Bsdf> first, Ref<Bsdf> second, Ref<Texture> weight);

  EventMask events() const override { return first_->events() | second_->events(); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  /// The smaller roughness of those that take part at the point.
  float roughness(const SurfacePoint& point) const override;
  float relative_ior() const override;
  Rgb albedo(const SurfacePoint& point) const override;
  bool needs_tangents() const override {
    return first_->needs_tangents() || second_->needs_tangents();
  }
  bool tilts_normal() const override { return first_->tilts_normal() || second_->tilts_normal(); }

 private:
  /// One of the two, as it takes part at a point.
  struct Part {
    const Bsdf& bsdf;
    Rgb weight;
    float probability;  ///< of being chosen [1]; 0 where it takes no part
  };
  struct Parts {
    std::array<Part, 2> both;
    LobeChoice choice;
  };
  Parts parts(const SurfacePoint& point, EventMask allowed) const;

  Ref<Bsdf> first_, second_;
  Ref<Texture> weight_;
};

}  // namespace pharos

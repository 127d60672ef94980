#pragma once

#include <array>

#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "lobe_choice.h"

namespace pharos {

/// The linear mix (1 - w) first + w second of two BSDFs, for each channel of a texture w in [0, 1].
///
/// sample() considers only the BSDFs that have an allowed event, and chooses between them by the
/// mean of w's channels. The densities are therefore mixtures of conditional densities. A direction
/// into which both BSDFs scatter gets the value and density of the mix. Discrete events of one kind
/// are merged into one outcome, so both BSDFs must send them in the same direction. Reflections
/// always follow the mirror direction, and light that passes through goes straight on; for
/// refraction see `blend`.
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
  /// The smaller roughness of the BSDFs that take part at the point.
  float roughness(const SurfacePoint& point) const override;
  float relative_ior() const override;
  Rgb albedo(const SurfacePoint& point) const override;
  bool needs_tangents() const override {
    return first_->needs_tangents() || second_->needs_tangents();
  }
  bool tilts_normal() const override { return first_->tilts_normal() || second_->tilts_normal(); }

 private:
  /// One of the two BSDFs with its share at a point.
  struct Part {
    const Bsdf& bsdf;
    Rgb weight;
    float probability;  ///< of being chosen [1]; 0 if it takes no part
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

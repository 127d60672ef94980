#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>

namespace pharos {

/// See two_sided.cpp.
class TwoSided final : public Bsdf {
 public:
  struct Settings {
    Ref<Bsdf> bsdf;
    Ref<Bsdf> back;  ///< null: same as `bsdf`
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if a material transmits light.
  explicit TwoSided(const Settings& settings);

  EventMask events() const override { return front_->events() | back_->events(); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float roughness(const SurfacePoint& point) const override;
  /// The albedo of the front; the visible side is not known here.
  Rgb albedo(const SurfacePoint& point) const override { return front_->albedo(point); }
  bool needs_tangents() const override {
    return front_->needs_tangents() || back_->needs_tangents();
  }
  bool tilts_normal() const override { return front_->tilts_normal() || back_->tilts_normal(); }

 private:
  Ref<Bsdf> front_, back_;
};

}  // namespace pharos

#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/bsdf.h>

namespace pharos {

/// See pass_through.cpp.
class PassThrough final : public Bsdf {
 public:
  using Settings = NoSettings;
  explicit PassThrough(const Settings& = {}) {}

  EventMask events() const override { return mask_of(Event::pass_through); }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 0; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(1); }
};

}  // namespace pharos

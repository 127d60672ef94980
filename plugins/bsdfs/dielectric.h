#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>

namespace pharos {

class Dielectric final : public Bsdf {
 public:
  struct Settings {
    float ior = 1.5f;
    static void describe(Schema<Settings>& s);
  };
  explicit Dielectric(const Settings& settings) : ior_(settings.ior) {}

  EventMask events() const override {
    return mask_of(Event::discrete_reflect) | mask_of(Event::discrete_transmit);
  }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 0; }
  float relative_ior() const override { return 1 / ior_; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(1); }

 private:
  float ior_;  ///< inside over outside
};

}  // namespace pharos

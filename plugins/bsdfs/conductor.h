#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "metals.h"

namespace pharos {

/// See conductor.cpp.
class Conductor final : public Bsdf {
 public:
  struct Settings {
    std::optional<Metal> material;
    std::optional<Rgb> eta, k;
    Ref<Texture> specular_reflectance;
    static void describe(Schema<Settings>& s);
  };
  explicit Conductor(const Settings& settings);

  EventMask events() const override { return mask_of(Event::discrete_reflect); }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 0; }
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  ComplexIor ior_;
  Ref<Texture> specular_reflectance_;
  Rgb average_fresnel_;  ///< mean over the hemisphere, approximate [1]
};

}  // namespace pharos

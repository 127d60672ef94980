#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// See thin_dielectric.cpp.
class ThinDielectric final : public Bsdf {
 public:
  struct Settings {
    float ior = 1.5f;
    Ref<Texture> specular_reflectance, specular_transmittance;
    static void describe(Schema<Settings>& s);
  };
  explicit ThinDielectric(const Settings& settings);

  EventMask events() const override {
    return mask_of(Event::discrete_reflect) | mask_of(Event::pass_through);
  }
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
  Settings settings_;
  float average_reflected_;  ///< over the hemisphere, all interreflection included [1]
};

}  // namespace pharos

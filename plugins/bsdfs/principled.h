#pragma once

#include <optional>

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "microfacet.h"
#include "principled_surface.h"

namespace pharos {

/// See principled.cpp.
class Principled final : public Bsdf {
 public:
  struct Settings {
    Ref<Texture> base_color;
    Ref<Texture> roughness, metallic;
    std::optional<float> specular, ior;
    Ref<Texture> spec_tint, spec_trans;
    Ref<Texture> sheen, sheen_tint;
    Ref<Texture> flatness;
    Ref<Texture> clearcoat, clearcoat_gloss;
    Masking masking = Masking::height_correlated;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if both `specular` and `ior` are given, or if the material transmits light
  /// at an index too close to one.
  explicit Principled(const Settings& settings);

  EventMask events() const override;
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint& point) const override;
  float relative_ior() const override { return is_clear_ ? 1 / ior_ : 1; }
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  PrincipledSurface surface(const SurfacePoint& point) const;

  Settings settings_;
  float ior_;
  bool is_clear_;          ///< whether the material transmits light anywhere
  float smallest_alpha_;   ///< smallest GGX alpha of the interface
  float average_fresnel_;  ///< mean over the outer hemisphere, for the interface [1]
};

}  // namespace pharos

#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "diffuse_base.h"
#include "lobe_choice.h"
#include "rough_coat.h"

namespace pharos {

/// See rough_plastic.cpp.
class RoughPlastic final : public Bsdf {
 public:
  struct Settings {
    float alpha = 0.1f;
    FacetDistribution distribution = FacetDistribution::ggx;
    float ior = 1.5f;
    Ref<Texture> reflectance;
    Ref<Texture> specular_reflectance;
    Masking masking = Masking::height_correlated;
    bool nonlinear = false;
    static void describe(Schema<Settings>& s);
  };
  explicit RoughPlastic(const Settings& settings);

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return settings_.alpha; }
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  /// The layers at a point for light from one direction.
  struct Layers {
    Rgb specular;       ///< factor on the coat's reflection [1]
    Rgb emerging;       ///< share of the light that has entered and finally leaves [1]
    float entering;     ///< share of light that enters the coat [1]
    LobeChoice choice;  ///< the coat comes first, the base second
  };
  Layers layers(const SurfacePoint& point, float cosine) const;
  /// The light that both layers scatter to `wi`.
  ScatterValue scattered(const Layers& layers, Vec3 wo, Vec3 wi) const;

  Settings settings_;
  RoughCoat coat_;
  DiffuseBase base_;
};

}  // namespace pharos

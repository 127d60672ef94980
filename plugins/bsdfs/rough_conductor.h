#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "facets.h"
#include "metals.h"

namespace pharos {

/// See rough_conductor.cpp.
class RoughConductor final : public Bsdf {
 public:
  struct Settings {
    float alpha = 0.1f;
    std::optional<float> alpha_v;
    FacetDistribution distribution = FacetDistribution::ggx;
    std::optional<Metal> material;
    std::optional<Rgb> eta, k;
    Masking masking = Masking::height_correlated;
    Ref<Texture> specular_reflectance;
    static void describe(Schema<Settings>& s);
  };
  explicit RoughConductor(const Settings& settings);

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return std::min(alpha_u(), alpha_v()); }
  Rgb albedo(const SurfacePoint& point) const override;
  bool needs_tangents() const override { return alpha_u() != alpha_v(); }

 private:
  float alpha_u() const { return settings_.alpha; }
  float alpha_v() const { return settings_.alpha_v.value_or(settings_.alpha); }
  /// Value over pdf, and pdf. The quotient does not need D(m).
  struct Reflection {
    Rgb weight;
    float pdf = 0;
  };
  Reflection reflect(const SurfacePoint& point, Vec3 wo, Vec3 wi) const;

  Settings settings_;
  ComplexIor ior_;
  Facets facets_;
  Rgb average_fresnel_;  ///< mean over the hemisphere, approximate [1]
};

}  // namespace pharos

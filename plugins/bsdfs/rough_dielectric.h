#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "facets.h"

namespace pharos {

/// See rough_dielectric.cpp.
class RoughDielectric final : public Bsdf {
 public:
  struct Settings {
    float alpha = 0.1f;
    std::optional<float> alpha_v;
    FacetDistribution distribution = FacetDistribution::ggx;
    float ior = 1.5f;
    Masking masking = Masking::height_correlated;
    Ref<Texture> specular_reflectance, specular_transmittance;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if the refracted lobe is too narrow for single precision.
  explicit RoughDielectric(const Settings& settings);

  EventMask events() const override {
    return mask_of(Event::smooth_reflect) | mask_of(Event::smooth_transmit);
  }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return std::min(alpha_u(), alpha_v()); }
  float relative_ior() const override { return 1 / settings_.ior; }
  Rgb albedo(const SurfacePoint& point) const override;
  bool needs_tangents() const override { return alpha_u() != alpha_v(); }

 private:
  float alpha_u() const { return settings_.alpha; }
  float alpha_v() const { return settings_.alpha_v.value_or(settings_.alpha); }
  /// Value over pdf, and pdf. The quotient does not need D(m).
  struct Scattering {
    Rgb weight;
    float pdf = 0;
  };
  /// Directions are flipped so that `wo` lies above; `eta` is the index below over the index above.
  Scattering reflect(const SurfacePoint& point, Vec3 wo, Vec3 wi, float eta,
                     EventMask events) const;
  Scattering refract(const SurfacePoint& point, Vec3 wo, Vec3 wi, float eta,
                     ScatterOptions options) const;
  Scattering scatter(const SurfacePoint& point, Vec3 wo, Vec3 wi, float eta,
                     ScatterOptions options) const;
  /// The index on the far side over the index on the side of `wo`.
  float eta_beyond(Vec3 wo) const { return wo.z > 0 ? settings_.ior : 1 / settings_.ior; }

  Settings settings_;
  Facets facets_;
  float average_fresnel_;  ///< mean over the outer hemisphere [1]
};

}  // namespace pharos

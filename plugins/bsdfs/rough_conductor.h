#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "microfacet.h"

namespace pharos {

/// How masking towards the sensor and shadowing towards the light go together.
enum class Masking {
  height_correlated,  ///< facets that are high are seen and lit more often (Heitz 2014)
  separable,          ///< as if independent: darker, as older renderers have it
};
template <>
struct EnumNames<Masking> {
  static constexpr std::array<std::pair<std::string_view, Masking>, 2> names{
      {{"height_correlated", Masking::height_correlated}, {"separable", Masking::separable}}};
};

class RoughConductor final : public Bsdf {
 public:
  struct Settings {
    float alpha = 0.1f;
    Rgb eta{0.20f, 0.92f, 1.10f};
    Rgb k{3.90f, 2.45f, 2.14f};
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
  float roughness(const SurfacePoint&) const override { return settings_.alpha; }
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  /// An evaluation with the quotient of value and pdf, which needs no D(m).
  struct Reflection {
    Rgb weight;
    float pdf = 0;
  };
  Reflection reflect(const SurfacePoint& point, Vec3 wo, Vec3 wi) const;

  Settings settings_;
  GgxDistribution facets_;
  Rgb average_fresnel_;  ///< over the hemisphere, approximately [1]
};

}  // namespace pharos

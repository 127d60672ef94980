#pragma once

#include <optional>

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "lobe_choice.h"

namespace pharos {

/// See phong.cpp.
class Phong final : public Bsdf {
 public:
  struct Settings {
    Ref<Texture> diffuse_reflectance;
    Ref<Texture> specular_reflectance;
    Ref<Texture> exponent;
    std::optional<float> rescale_to;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if the reflectances may add up to more than 1 and are not rescaled.
  explicit Phong(const Settings& settings);

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint& point) const override;
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  /// The parameters at a point.
  struct Lobes {
    Rgb diffuse, specular;  ///< shares at normal incidence [1]
    float exponent;
    LobeChoice choice;  ///< the specular lobe comes first
  };
  Lobes lobes(const SurfacePoint& point) const;
  static ScatterValue scattered(const Lobes& lobes, Vec3 wo, Vec3 wi);

  Settings settings_;
  float scale_ = 1;  ///< factor on both reflectances
};

}  // namespace pharos

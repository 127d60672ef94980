#pragma once

#include <array>

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "lobe_choice.h"

namespace pharos {

/// The scale factor of Ward's lobe; see ward.cpp.
enum class WardVariant { ward, ward_duer, balanced };
template <>
struct EnumNames<WardVariant> {
  static constexpr auto names =
      std::to_array<EnumName<WardVariant>>({{"ward", WardVariant::ward},
                                            {"ward_duer", WardVariant::ward_duer},
                                            {"balanced", WardVariant::balanced}});
};

/// See ward.cpp.
class Ward final : public Bsdf {
 public:
  struct Settings {
    float alpha_u = 0.1f;
    float alpha_v = 0.1f;
    Ref<Texture> specular_reflectance;
    Ref<Texture> diffuse_reflectance;
    WardVariant variant = WardVariant::balanced;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if both reflectances may add up to more than one.
  explicit Ward(const Settings& settings);

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override {
    return std::min(settings_.alpha_u, settings_.alpha_v);
  }
  Rgb albedo(const SurfacePoint& point) const override;
  bool needs_tangents() const override { return settings_.alpha_u != settings_.alpha_v; }

 private:
  /// Both lobes at a point.
  struct Lobes {
    Rgb specular, diffuse;
    LobeChoice choice;  ///< the specular lobe comes first
  };
  Lobes lobes(const SurfacePoint& point) const;
  /// The light that both lobes scatter from `wo` to `wi`, both with z > 0.
  ScatterValue scattered(const Lobes& lobes, Vec3 wo, Vec3 wi) const;
  /// The specular lobe for a reflectance of one: value f |cos(wi)| over pdf, and pdf.
  struct Glossy {
    float weight = 0;  ///< [1]
    float pdf = 0;     ///< [1/sr]
  };
  Glossy glossy(Vec3 wo, Vec3 wi) const;
  /// Draws a direction with the density of glossy(); its z may be negative.
  Vec3 sample_glossy(Vec3 wo, Vec2 u) const;

  Settings settings_;
};

}  // namespace pharos

#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "diffuse_base.h"
#include "lobe_choice.h"

namespace pharos {

/// See plastic.cpp.
class Plastic final : public Bsdf {
 public:
  struct Settings {
    float ior = 1.5f;
    Ref<Texture> reflectance;
    Ref<Texture> specular_reflectance;
    bool nonlinear = false;
    static void describe(Schema<Settings>& s);
  };
  explicit Plastic(const Settings& settings);

  EventMask events() const override {
    return mask_of(Event::discrete_reflect) | mask_of(Event::smooth_reflect);
  }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 0; }
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  /// The coat's reflectance [1].
  float coat(float cosine) const;
  /// The layers at a point for light from one direction, restricted to the allowed events.
  struct Layers {
    Rgb mirrored;       ///< share that the coat mirrors [1]
    Rgb emerging;       ///< share of the light that has entered and finally leaves [1]
    float entering;     ///< share that enters the coat [1]
    LobeChoice choice;  ///< the coat comes first, the base second
  };
  Layers layers(const SurfacePoint& point, float cosine, EventMask allowed) const;
  /// The light that the base scatters to `wi`.
  ScatterValue scattered(const Layers& layers, Vec3 wi) const;

  Settings settings_;
  DiffuseBase base_;
};

}  // namespace pharos

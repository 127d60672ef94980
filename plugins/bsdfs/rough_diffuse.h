#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "hemisphere_warp.h"

namespace pharos {

/// See rough_diffuse.cpp.
class RoughDiffuse final : public Bsdf {
 public:
  struct Settings {
    Ref<Texture> reflectance;
    Ref<Texture> alpha;
    bool use_fast_approx = false;
    HemisphereWarp warp = HemisphereWarp::concentric;
    static void describe(Schema<Settings>& s);
  };
  explicit RoughDiffuse(const Settings& settings) : settings_(settings) {}

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 1; }
  /// The reflectance of the facets. The albedo of a rough surface is lower by a few percent.
  Rgb albedo(const SurfacePoint& point) const override {
    return settings_.reflectance->evaluate(point);
  }

 private:
  Settings settings_;
};

}  // namespace pharos

#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

namespace pharos {

class Diffuse final : public Bsdf {
 public:
  struct Settings {
    Ref<Texture> reflectance;
    static void describe(Schema<Settings>& s);
  };
  explicit Diffuse(const Settings& settings) : reflectance_(settings.reflectance) {}

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint& point) const override { return reflectance_->evaluate(point); }

 private:
  Ref<Texture> reflectance_;
};

}  // namespace pharos

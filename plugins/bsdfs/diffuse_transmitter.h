#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "hemisphere_warp.h"
#include "lobe_choice.h"

namespace pharos {

/// See diffuse_transmitter.cpp.
class DiffuseTransmitter final : public Bsdf {
 public:
  struct Settings {
    Ref<Texture> transmittance;
    Ref<Texture> reflectance;
    HemisphereWarp warp = HemisphereWarp::concentric;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if more light might leave than arrives; the .cpp describes the check.
  explicit DiffuseTransmitter(const Settings& settings);

  EventMask events() const override;
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint& point) const override;

 private:
  /// Both lobes at a point and the choice between them; reflection comes first.
  struct Lobes {
    Rgb reflectance, transmittance;
    LobeChoice choice;
  };
  Lobes lobes(const SurfacePoint& point, EventMask allowed) const;

  Settings settings_;
};

}  // namespace pharos

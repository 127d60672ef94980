#pragma once

#include <pharos/config/schema.h>

#include "smooth_interface.h"

namespace pharos {

/// See dielectric.cpp.
class Dielectric final : public SmoothInterface {
 public:
  struct Settings {
    float ior = 1.5f;
    Ref<Texture> specular_reflectance, specular_transmittance;
    static void describe(Schema<Settings>& s);
  };
  explicit Dielectric(const Settings& settings);

  EventMask events() const override {
    return mask_of(Event::discrete_reflect) | mask_of(Event::discrete_transmit);
  }
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float relative_ior() const override { return 1 / ior_; }

 private:
  float ior_;
};

}  // namespace pharos

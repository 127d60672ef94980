#pragma once

#include <utility>

#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>

#include "discrete_choice.h"

namespace pharos {

/// The common base of smooth interfaces that split light into a mirrored and a transmitted part.
/// All their events are discrete. The shares alone determine the choice between events, and two
/// textures tint the parts.
class SmoothInterface : public Bsdf {
 public:
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2,
                                      ScatterOptions options) const override {
    return draw_outcome(discrete(point, wo, options), u_choice);
  }
  float roughness(const SurfacePoint&) const override { return 0; }
  Rgb albedo(const SurfacePoint& point) const override {
    return average_reflected_ * reflectance_->evaluate(point) +
           (1 - average_reflected_) * transmittance_->evaluate(point);
  }

 protected:
  /// Takes the factors on both parts, and the share [1] of uniform light that is mirrored.
  SmoothInterface(Ref<Texture> reflectance, Ref<Texture> transmittance, float average_reflected)
      : reflectance_(std::move(reflectance)),
        transmittance_(std::move(transmittance)),
        average_reflected_(average_reflected) {}

  /// How the transmitted part continues.
  struct Onward {
    Event event;
    Vec3 direction;
    float scale = 1;  ///< factor on radiance for compressed solid angle
  };
  /// Returns both parts, as far as they are allowed, if the share `reflected` of light from `wo` is
  /// mirrored.
  DiscreteOutcomes split(const SurfacePoint& point, Vec3 wo, float reflected, const Onward& onward,
                         EventMask allowed) const {
    const float transmitted = 1 - reflected;
    return allowed_outcomes(
        {Event::discrete_reflect,
         {-wo.x, -wo.y, wo.z},
         reflected * reflectance_->evaluate(point),
         reflected},
        {onward.event, onward.direction,
         onward.scale * transmitted * transmittance_->evaluate(point), transmitted},
        allowed);
  }

 private:
  Ref<Texture> reflectance_, transmittance_;
  float average_reflected_;
};

}  // namespace pharos

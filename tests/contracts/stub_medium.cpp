// A gray homogeneous medium with isotropic scattering. Stub (c) samples distances in it.

#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>
#include <pharos/scene/medium.h>

#include "stubs.h"

namespace pharos::stubs {
namespace {

class Isotropic final : public PhaseFunction {
 public:
  float evaluate(Vec3, Vec3) const override { return warp::sphere_pdf(); }
  Vec3 sample(Vec3, Vec2 u) const override { return warp::sphere_from_square(u); }
  float mean_cosine() const override { return 0; }
};

class GrayMedium final : public Medium {
 public:
  struct Settings {
    float scattering = 1;
    static void describe(Schema<Settings>& s) {
      s.field("scattering", &Settings::scattering, "Scattering coefficient").unit("1/m").above(0);
    }
  };
  explicit GrayMedium(Settings settings) : sigma_(settings.scattering) {}

  DistanceSample sample(const Ray& ray, Rgb, float, float u) const override {
    const float t = -std::log1p(-u) / sigma_;
    return {t, t < ray.t_max};
  }
  MediumLeg leg(const Ray&, Rgb, float t) const override {
    const float left = std::exp(-sigma_ * t);
    return {Rgb(left), left, sigma_ * left};
  }
  Rgb scattering(Point3) const override { return Rgb(sigma_); }
  const PhaseFunction& phase_function() const override { return phase_; }

 private:
  float sigma_;
  Isotropic phase_;
};

}  // namespace

void register_medium(Registry& registry) {
  registry.add<GrayMedium>("stub_gray", "Scatters, never absorbs");
}

}  // namespace pharos::stubs

// constant: an environment that sends the same radiance from every direction, sampled uniformly
// over the sphere of directions (density 1/(4 pi) [1/sr]). A closed white furnace in one line.
//
//     emitters: [ { type: constant, radiance: [0.5, 0.7, 1] } ]

#include "constant.h"

#include <pharos/core/warp.h>

namespace pharos {
namespace {

class ConstantLight : public Light {
 public:
  ConstantLight(Rgb radiance, const EmitterSite& site) : radiance_(radiance), site_(site) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    const Vec3 direction = warp::sphere_from_square(u);
    LightSample sample;
    sample.direction = direction;
    sample.distance = kInfinity;
    sample.radiance = radiance_;
    sample.pdf = warp::sphere_pdf();
    sample.kind = VertexKind::environment;
    // Outside the scene's sphere wherever `from` is.
    const float beyond = 2 * site_.scene_radius + length(from - site_.scene_center);
    sample.point.position = from + beyond * direction;
    sample.point.normal = -direction;
    sample.point.shading = Frame::from_normal(-direction);
    return sample;
  }

  bool is_environment() const override { return true; }
  float pdf_direction(Vec3) const override { return warp::sphere_pdf(); }
  Rgb environment_radiance(Vec3) const override { return radiance_; }

  /// What enters the scene's sphere: pi times the radiance over 4 pi r^2.
  float power() const override {
    return 4 * kPi * kPi * square(site_.scene_radius) * mean(radiance_);
  }

 private:
  Rgb radiance_;
  EmitterSite site_;
};

}  // namespace

void ConstantEmitter::Settings::describe(Schema<Settings>& s) {
  s.field("radiance", &Settings::radiance, "Radiance from every direction")
      .unit("W/(m^2 sr)")
      .at_least(0);
  s.field("scale", &Settings::scale, "Factor on the radiance").at_least(0);
}

std::unique_ptr<const Light> ConstantEmitter::place(const EmitterSite& site) const {
  return std::make_unique<const ConstantLight>(radiance_, site);
}

}  // namespace pharos

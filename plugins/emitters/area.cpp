// area: a shape shines. Every point sends `scale` times the texture `radiance` [W/(m^2 sr)] into
// every direction on the side of its normal and nothing to the other side. A colour or a number
// may stand for the texture.
//
//     type: quad
//     emitter: { type: area, radiance: [4, 3, 2], scale: 10 }

#include "area.h"

namespace pharos {
namespace {

class AreaLight : public Light {
 public:
  AreaLight(const AreaEmitter::Settings& settings, const EmitterSite& site)
      : settings_(settings), shape_(*site.shape), object_(site.object) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    const ShapeSample on_shape = shape_.sample_from(from, u);
    LightSample sample;
    sample.pdf = on_shape.pdf;
    sample.point = on_shape.point;
    sample.point.object = object_;
    const Vec3 d = sample.point.position - from;
    sample.distance = length(d);
    if (!(sample.distance > 0)) {
      sample.pdf = 0;
      return sample;
    }
    sample.direction = d / sample.distance;
    sample.radiance = radiance(sample.point, -sample.direction);
    return sample;
  }

  float pdf_point(Point3 from, const SurfacePoint& point) const override {
    return shape_.pdf_from(from, point);
  }

  Rgb radiance(const SurfacePoint& point, Vec3 direction) const override {
    if (dot(direction, point.normal) <= 0) return {};
    return settings_.scale * settings_.radiance->evaluate(point);
  }

  /// Radiance times pi over the area: the hemisphere's projected solid angle.
  float power() const override {
    return settings_.scale * kPi * shape_.area() * mean(settings_.radiance->average());
  }

 private:
  const AreaEmitter::Settings& settings_;
  const Shape& shape_;
  std::uint32_t object_;
};

}  // namespace

void AreaEmitter::Settings::describe(Schema<Settings>& s) {
  s.field("radiance", &Settings::radiance, "Radiance on the side of the normal")
      .unit("W/(m^2 sr)")
      .required()
      .check(">= 0", [](const Ref<Texture>& texture) {
        const Rgb average = texture->average();
        return is_finite(average) && all_at_least(average, 0);
      });
  s.field("scale", &Settings::scale, "Factor on the radiance").at_least(0);
}

std::unique_ptr<const Light> AreaEmitter::place(const EmitterSite& site) const {
  return std::make_unique<const AreaLight>(settings_, site);
}

}  // namespace pharos

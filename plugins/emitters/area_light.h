#pragma once

#include <algorithm>
#include <utility>

#include <pharos/config/registry.h>
#include <pharos/core/frame.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/texture.h>

#include "front_side.h"

namespace pharos {

/// Declares `radiance` and `scale`, the common parameters of all lights on shapes.
template <class Settings>
void describe_radiance(Schema<Settings>& s, std::string help) {
  s.field("radiance", &Settings::radiance, std::move(help))
      .unit("W/(m^2 sr)")
      .required()
      .check(">= 0", [](const Ref<Texture>& texture) {
        const Rgb average = texture->average();
        return is_finite(average) && all_at_least(average, 0);
      });
  s.field("scale", &Settings::scale, "Factor on the radiance").at_least(0);
}

/// A light on a shape. Its radiance is `scale` times the texture `radiance` times the lobe's factor
/// for the angle to the geometric normal. It emits nothing on the other side. Positions are sampled
/// as the shape samples them.
///
/// `Lobe` has `float operator()(float cosine) const`, the factor [1] for a cosine in (0, 1], and
/// `float projected_solid_angle() const`, the integral of factor times cosine over the hemisphere
/// [sr]. `Vec3 sample(Vec2 u) const` draws a direction about +z. Its density `float pdf(float
/// cosine) const` [1/sr] is roughly proportional to factor times cosine.
template <class Lobe>
class AreaLight final : public Light {
 public:
  AreaLight(const Texture& radiance, float scale, Lobe lobe, const EmitterSite& site)
      : radiance_(radiance),
        scale_(scale),
        lobe_(lobe),
        shape_(*site.shape),
        front_(shape_),
        object_(site.object) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    if (front_.excludes(from)) return {};
    ShapeSample on_shape = shape_.sample_from(from, u);
    on_shape.point.object = object_;
    const Vec3 d = on_shape.point.position - from;
    const float distance = length(d);
    if (!(distance > 0)) return {.point = on_shape.point};
    const Vec3 direction = d / distance;
    return {.direction = direction,
            .distance = distance,
            .radiance = radiance(on_shape.point, -direction),
            .pdf = on_shape.pdf,
            .point = on_shape.point};
  }

  float pdf_point(Point3 from, const SurfacePoint& point) const override {
    return front_.excludes(from) ? 0 : shape_.pdf_from(from, point);
  }

  Rgb radiance(const SurfacePoint& point, Vec3 direction) const override {
    // The product of two rounded unit vectors may exceed one, and narrow lobes magnify this error.
    const float cosine = std::min(1.0f, dot(direction, point.normal));
    if (cosine <= 0) return {};
    return scale_ * lobe_(cosine) * radiance_.evaluate(point);
  }

  EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const override {
    const ShapeSample on_shape = shape_.sample(u_position);
    const Vec3 local = lobe_.sample(u_direction);
    EmissionSample sample{.point = on_shape.point};
    sample.point.object = object_;
    sample.direction = Frame::from_normal(sample.point.normal).to_world(local);
    const EmissionDensity pdf{on_shape.pdf, lobe_.pdf(local.z)};
    if (!(local.z > 0) || !(pdf.position * pdf.direction > 0)) return sample;
    sample.pdf = pdf;
    sample.weight =
        local.z / pdf.position / pdf.direction * radiance(sample.point, sample.direction);
    return sample;
  }
  EmissionDensity pdf_emission(const SurfacePoint& point, Vec3 direction) const override {
    const float cosine = std::min(1.0f, dot(direction, point.normal));
    return {1 / shape_.area(), cosine > 0 ? lobe_.pdf(cosine) : 0};
  }

  float power() const override {
    return scale_ * lobe_.projected_solid_angle() * shape_.area() * mean(radiance_.average());
  }

 private:
  const Texture& radiance_;
  float scale_;
  Lobe lobe_;
  const Shape& shape_;
  FrontSide front_;
  std::uint32_t object_;
};

}  // namespace pharos

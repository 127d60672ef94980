#pragma once

#include <array>
#include <optional>

#include <pharos/config/schema.h>
#include <pharos/core/transform.h>
#include <pharos/scene/shape.h>

#include "round_shape.h"

namespace pharos {

/// See sphere.cpp.
class Sphere : public Shape {
 public:
  struct Settings {
    Point3 center = {};
    float radius = 1;
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError if `to_world` does not keep spheres spheres.
  explicit Sphere(const Settings& settings);

  Bounds3 bounds() const override;
  float area() const override { return 4 * kPi * radius_ * radius_; }
  bool intersect(const Ray& ray, std::uint32_t primitive, PrimitiveHit& hit) const override;
  SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const override;
  UvTangents uv_tangents(const SurfacePoint& point) const override;
  ShapeSample sample(Vec2 u) const override;
  /// From outside, samples uniformly over the cone of directions that meet the sphere. From inside,
  /// samples in the same way as sample().
  ShapeSample sample_from(Point3 from, Vec2 u) const override;
  float pdf_from(Point3 from, const SurfacePoint& point) const override;

 private:
  /// Returns both parameters at which the line of the ray intersects the sphere, ascending.
  std::optional<std::array<double, 2>> roots(const Ray& ray) const;
  /// Returns the surface point in the direction `outward` (of any length) from the center.
  SurfacePoint surface_towards(Double3 outward) const;
  Double3 from_center(Point3 p) const { return Double3(p) - Double3(center_); }
  /// Returns 1 - cos of the half-angle of the cone of directions that meet the sphere. Empty from
  /// inside, and for flipped spheres, which are lit and seen from inside.
  std::optional<float> cone_from(Point3 from) const;

  Point3 center_;
  float radius_;
  Transform to_world_;
  bool flip_normals_;
};

}  // namespace pharos

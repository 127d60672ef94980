#pragma once

#include <array>
#include <optional>

#include <pharos/config/schema.h>
#include <pharos/core/transform.h>
#include <pharos/scene/shape.h>

#include "double3.h"

namespace pharos {

/// See cylinder.cpp.
class Cylinder : public Shape {
 public:
  struct Settings {
    Point3 p0{0, 0, -1}, p1{0, 0, 1};
    float radius = 1;
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError when both ends coincide or `to_world` does not keep the tube round.
  explicit Cylinder(const Settings& settings);

  Bounds3 bounds() const override;
  float area() const override { return area_; }
  /// The hit's first coordinate says which of the line's two meetings it is, 0 or 1.
  bool intersect(const Ray& ray, std::uint32_t primitive, PrimitiveHit& hit) const override;
  SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const override;
  UvTangents uv_tangents(const SurfacePoint& point) const override;
  ShapeSample sample(Vec2 u) const override;
  /// Uniform over height and projected angle, on the side of the wall whose outer side faces
  /// `from`; over the whole wall from inside.
  ShapeSample sample_from(Point3 from, Vec2 u) const override;
  float pdf_from(Point3 from, const SurfacePoint& point) const override;

 private:
  /// A vector's components along side_, across_ and axis_.
  Double3 to_local(Double3 v) const { return {dot(v, side_), dot(v, across_), dot(v, axis_)}; }
  Double3 to_local(Point3 p) const { return to_local(Double3(p) - Double3(base_)); }
  /// The surface nearest to a local point off the axis.
  SurfacePoint surface_near(Double3 local) const;
  /// Half of the angle that the tube fills around a local point, in projection along the axis.
  double half_angle_from(Double3 local) const;
  /// The density [1/sr] with which sample_from() draws a point that it can draw.
  float strip_pdf(Double3 local, const SurfacePoint& point) const;

  Point3 base_;                   ///< the middle of the end at p0
  Double3 axis_, side_, across_;  ///< orthonormal: towards p1, azimuth zero and a quarter turn
  double height_ = 0, radius_ = 0;
  float area_ = 0;
  float error_ = 0;  ///< SurfacePoint::error
  bool flip_normals_;
};

}  // namespace pharos

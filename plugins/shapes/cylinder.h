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

  /// Throws InputError if both ends coincide or `to_world` does not keep the tube round.
  explicit Cylinder(const Settings& settings);

  Bounds3 bounds() const override;
  float area() const override { return area_; }
  /// The first coordinate of the hit selects one of the two intersections with the line, 0 or 1.
  bool intersect(const Ray& ray, std::uint32_t primitive, PrimitiveHit& hit) const override;
  SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const override;
  UvTangents uv_tangents(const SurfacePoint& point) const override;
  ShapeSample sample(Vec2 u) const override;
  /// Samples uniformly over the height and the projected angle. From outside, the samples lie on
  /// the side of the wall whose outer surface faces `from`; from inside, they lie on the whole
  /// wall.
  ShapeSample sample_from(Point3 from, Vec2 u) const override;
  float pdf_from(Point3 from, const SurfacePoint& point) const override;

 private:
  /// Returns the components of a vector along side_, across_ and axis_.
  Double3 to_local(Double3 v) const { return {dot(v, side_), dot(v, across_), dot(v, axis_)}; }
  Double3 to_local(Point3 p) const { return to_local(Double3(p) - Double3(base_)); }
  /// Returns the surface point nearest to a local point off the axis.
  SurfacePoint surface_near(Double3 local) const;
  /// Returns half of the angle that the tube subtends at a local point, in projection along the
  /// axis.
  double half_angle_from(Double3 local) const;
  /// Returns the density [1/sr] of sample_from() at a point that it can draw.
  float strip_pdf(Double3 local, const SurfacePoint& point) const;

  Point3 base_;                   ///< the center of the end at p0
  Double3 axis_, side_, across_;  ///< orthonormal: towards p1, azimuth zero and a quarter turn
  double height_ = 0, radius_ = 0;
  float area_ = 0;
  float error_ = 0;  ///< SurfacePoint::error
  bool flip_normals_;
};

}  // namespace pharos

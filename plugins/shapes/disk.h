#pragma once

#include <pharos/config/schema.h>
#include <pharos/core/transform.h>
#include <pharos/scene/shape.h>

#include "double3.h"

namespace pharos {

/// See disk.cpp.
class Disk : public Shape {
 public:
  struct Settings {
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  explicit Disk(const Settings& settings);

  Bounds3 bounds() const override;
  float area() const override { return area_; }
  /// The coordinates of the hit are the local x and y.
  bool intersect(const Ray& ray, std::uint32_t primitive, PrimitiveHit& hit) const override;
  SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const override;
  UvTangents uv_tangents(const SurfacePoint& point) const override;
  ShapeSample sample(Vec2 u) const override;

 private:
  /// Returns the surface at a point of the unit disk.
  SurfacePoint surface_at(Vec2 local) const;

  Point3 center_;
  Vec3 axis_x_, axis_y_;     ///< local x and y in world space: two conjugate radii of the ellipse
  Double3 normal_;           ///< x cross y, not unit
  Double3 dual_x_, dual_y_;  ///< their dot products with a point of the plane are local x and y
  float area_ = 0;
  float largest_radius_ = 1;  ///< of local points: the rim minus a margin for rounding
  SurfacePoint common_;       ///< the data that all points share
};

}  // namespace pharos

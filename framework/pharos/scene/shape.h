#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/core/bounds.h>
#include <pharos/core/ray.h>
#include <pharos/scene/surface_point.h>

namespace pharos {

/// What every hit of a triangle needs, computed once and in one cache line.
struct alignas(64) TriangleFacts {
  Point3 origin;          ///< vertex 0
  Vec3 edge1, edge2;      ///< from vertex 0 to vertices 1 and 2
  Vec3 normal;            ///< unit
  float error = 0;        ///< see SurfacePoint::error
  float edge_weight = 0;  ///< barycentric weights below this may lie within `error` of an edge
};

/// Indexed triangles in world space, counter-clockwise as seen from the outer side. `normals` and
/// `uvs` are empty or one per position. Who fills it in sees to it that positions are finite,
/// indices valid and areas positive.
struct TriangleMesh {
  std::vector<Point3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<TriangleFacts> facts;  ///< made by precompute(); empty: computed at every hit

  /// Fills `facts`; to be called when the rest is complete.
  void precompute();

  /// The surface at barycentric weights (b1, b2) of `triangle`'s vertices 1 and 2. Where there are
  /// no `uvs`, texture coordinates are those weights; where there are no `normals`, or they cancel
  /// out, the shading normal is the geometric one. The position keeps `error` away from the edges,
  /// so that origin_towards() does not slip past the neighbor at a concave edge.
  SurfacePoint surface_point(std::uint32_t triangle, float b1, float b2) const;
  /// The position of surface_point(), kept `margin` away from the edges instead [scene units].
  Point3 position_off_edges(std::uint32_t triangle, float b1, float b2, float margin) const;
  /// How the position moves with the texture coordinates, the same all over a triangle; zero where
  /// these have no area in it.
  UvTangents uv_tangents(std::uint32_t triangle) const;
  /// [scene units^2]
  float area(std::uint32_t triangle) const;
  Bounds3 bounds() const;

 private:
  TriangleFacts facts_of(std::uint32_t triangle) const;
  /// Keeps a distance of `margin` times the triangle's `error` from the edges.
  Point3 position_at(std::uint32_t triangle, const std::array<float, 3>& weights,
                     const TriangleFacts& f, float margin) const;
};

/// Where a ray met a primitive, in the primitive's own terms.
struct PrimitiveHit {
  float t = kInfinity;  ///< distance [scene units]
  Vec2 coordinates;     ///< meaning is the shape's own; barycentric (b1, b2) for meshes
  std::uint32_t primitive = 0;
};

/// A point drawn from a shape's surface; a shape leaves `point.object` to the scene.
struct ShapeSample {
  SurfacePoint point;
  float pdf = 0;  ///< [1/m^2] from sample(), [1/sr] from sample_from()
};

/// Contract: a surface in world space. Thread-safe. A shape is either a triangle mesh (mesh()
/// not null; Embree intersects it) or analytic (intersect() is called).
class Shape : public Component {
 public:
  static constexpr std::string_view contract_name = "shape";

  virtual Bounds3 bounds() const = 0;
  /// Of all primitives [scene units^2], > 0.
  virtual float area() const = 0;

  /// The triangles, or null for an analytic shape. Lives as long as the shape.
  virtual const TriangleMesh* mesh() const { return nullptr; }

  /// Analytic shapes: bounds of a primitive.
  virtual std::uint32_t primitive_count() const { return 1; }
  virtual Bounds3 primitive_bounds(std::uint32_t) const { return bounds(); }
  /// Analytic shapes: the nearest hit with 0 < t < ray.t_max; false when there is none.
  virtual bool intersect(const Ray&, std::uint32_t, PrimitiveHit&) const { return false; }
  /// The surface at a hit that intersect() or Embree reported; `object` is filled in by Scene.
  virtual SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const;

  /// How the position moves with the texture coordinates at a point that surface_point() gave; zero
  /// where it has no derivative. By default that of the triangle; zero for analytic shapes.
  virtual UvTangents uv_tangents(const SurfacePoint& point) const;

  /// Uniform over the area; pdf 1 / area() [1/m^2].
  virtual ShapeSample sample(Vec2 u) const = 0;

  /// A point as seen from `from`, pdf in solid angle there [1/sr]; pdf 0 when nothing can be seen.
  /// By default sample() converted by distance^2 / |cos|.
  virtual ShapeSample sample_from(Point3 from, Vec2 u) const;
  /// The density [1/sr] with which sample_from(from) yields `point`.
  virtual float pdf_from(Point3 from, const SurfacePoint& point) const;
};

/// Converts a density over area [1/m^2] at `point` into one over solid angle [1/sr] at `from`;
/// 0 when the surface is seen edge-on.
inline float solid_angle_pdf_from_area(float area_pdf, Point3 from, Point3 point, Vec3 normal) {
  const Vec3 d = point - from;
  const float distance_squared = length_squared(d);
  const float projected = abs_dot(d, normal);  // distance times |cos|
  return projected > 0 ? area_pdf * distance_squared * std::sqrt(distance_squared) / projected : 0;
}

/// The inverse conversion: [1/sr] at `from` into [1/m^2] at `point`; 0 where the two coincide.
inline float area_pdf_from_solid_angle(float solid_angle_pdf, Point3 from, Point3 point,
                                       Vec3 normal) {
  const Vec3 d = point - from;
  const float distance_squared = length_squared(d);
  if (distance_squared == 0) return 0;
  return solid_angle_pdf * abs_dot(d, normal) / (distance_squared * std::sqrt(distance_squared));
}

}  // namespace pharos

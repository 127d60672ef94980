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

/// Distance of positions from a triangle's edges, in units of SurfacePoint::error. A ray's origin
/// lies one unit off its triangle. If the next triangle meets this one at an acute angle, the
/// origin stays between the two only where the position is at least 1 / tan(angle) units away from
/// their edge. Two units suffice for angles above 27 degrees.
inline constexpr float kEdgeMargin = 2;

/// Precomputed data for a hit on a triangle, in one cache line.
struct alignas(64) TriangleFacts {
  Point3 origin;          ///< vertex 0
  Vec3 edge1, edge2;      ///< from vertex 0 to vertices 1 and 2
  Vec3 normal;            ///< unit
  float error = 0;        ///< see SurfacePoint::error
  float edge_weight = 0;  ///< barycentric weights below this may be within `error` of an edge
};

/// Indexed triangles in world space, counter-clockwise as seen from the outer side. `normals` and
/// `uvs` are empty or have one element per position. The code that fills the mesh must ensure that
/// positions are finite, indices are valid and areas are positive.
struct TriangleMesh {
  std::vector<Point3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<TriangleFacts> facts;  ///< filled by precompute(); if empty, computed at every hit

  /// Fills `facts`. Call it when the other members are complete.
  void precompute();

  /// Returns the surface at barycentric weights (b1, b2) of `triangle`'s vertices 1 and 2. Without
  /// `uvs`, these weights are the texture coordinates. Without `normals`, or if the normals cancel
  /// out, the shading normal is the geometric one. The position stays at least kEdgeMargin *
  /// `error` away from the edges, so that origin_towards() does not slip past the neighboring
  /// triangle at a concave edge.
  SurfacePoint surface_point(std::uint32_t triangle, float b1, float b2) const;
  /// Returns the position of surface_point(), but at least `margin` away from the edges [scene
  /// units].
  Point3 position_off_edges(std::uint32_t triangle, float b1, float b2, float margin) const;
  /// Returns the derivatives of the position by the texture coordinates, which are constant on a
  /// triangle. They are zero if the triangle has no area in texture space.
  UvTangents uv_tangents(std::uint32_t triangle) const;
  /// The area of a triangle [scene units^2].
  float area(std::uint32_t triangle) const;
  Bounds3 bounds() const;

 private:
  TriangleFacts facts_of(std::uint32_t triangle) const;
};

/// The hit of a ray on a primitive.
struct PrimitiveHit {
  float t = kInfinity;  ///< distance [scene units]
  Vec2 coordinates;     ///< defined by the shape; barycentric (b1, b2) for meshes
  std::uint32_t primitive = 0;
};

/// A point drawn from a shape's surface. The scene fills in `point.object`, not the shape.
struct ShapeSample {
  SurfacePoint point;
  float pdf = 0;  ///< [1/m^2] from sample(), [1/sr] from sample_from()
};

/// Contract: a surface in world space. Thread-safe. A shape is either a triangle mesh or analytic.
/// If mesh() is not null, Embree intersects the mesh; otherwise intersect() is called.
class Shape : public Component {
 public:
  static constexpr std::string_view contract_name = "shape";

  virtual Bounds3 bounds() const = 0;
  /// The area of all primitives [scene units^2]. It is zero for meshes without a triangle, which
  /// scenes leave out; only bounds() is called on them besides.
  virtual float area() const = 0;

  /// The triangles, or null for an analytic shape. They live as long as the shape.
  virtual const TriangleMesh* mesh() const { return nullptr; }

  /// The number of primitives and their bounds. Analytic shapes only.
  virtual std::uint32_t primitive_count() const { return 1; }
  virtual Bounds3 primitive_bounds(std::uint32_t) const { return bounds(); }
  /// Finds the nearest hit with 0 < t < ray.t_max and returns whether there is one. Analytic shapes
  /// only.
  virtual bool intersect(const Ray&, std::uint32_t, PrimitiveHit&) const { return false; }
  /// Returns the surface at a hit that intersect() or Embree reported. Scene fills in `object`.
  virtual SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const;

  /// Returns the derivatives of the position by the texture coordinates at a point from
  /// surface_point(). They are zero if the position has no derivative. The default returns the
  /// triangle's derivatives, and zero for analytic shapes.
  virtual UvTangents uv_tangents(const SurfacePoint& point) const;

  /// Draws a point uniformly over the area. The pdf is 1 / area() [1/m^2].
  virtual ShapeSample sample(Vec2 u) const = 0;

  /// Draws a point as seen from `from`. The pdf is a density over solid angle at `from` [1/sr] and
  /// 0 if nothing can be seen. The default converts the pdf of sample() by distance^2 / |cos|.
  virtual ShapeSample sample_from(Point3 from, Vec2 u) const;
  /// The density [1/sr] with which sample_from(from) yields `point`.
  virtual float pdf_from(Point3 from, const SurfacePoint& point) const;
};

/// Converts a density over area [1/m^2] at `point` into a density over solid angle [1/sr] at
/// `from`. Returns 0 if the surface is seen edge-on.
inline float solid_angle_pdf_from_area(float area_pdf, Point3 from, Point3 point, Vec3 normal) {
  const Vec3 d = point - from;
  const float distance_squared = length_squared(d);
  const float projected = abs_dot(d, normal);  // distance times |cos|
  return projected > 0 ? area_pdf * distance_squared * std::sqrt(distance_squared) / projected : 0;
}

/// Converts a density over solid angle [1/sr] at `from` into a density over area [1/m^2] at
/// `point`. Returns 0 if the two points coincide.
inline float area_pdf_from_solid_angle(float solid_angle_pdf, Point3 from, Point3 point,
                                       Vec3 normal) {
  const Vec3 d = point - from;
  const float distance_squared = length_squared(d);
  if (distance_squared == 0) return 0;
  return solid_angle_pdf * abs_dot(d, normal) / (distance_squared * std::sqrt(distance_squared));
}

}  // namespace pharos

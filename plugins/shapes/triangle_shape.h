#pragma once

#include <string>
#include <vector>

#include <pharos/core/transform.h>
#include <pharos/scene/shape.h>

namespace pharos {

/// Base class of the shapes made of triangles.
class TriangleShape : public Shape {
 public:
  Bounds3 bounds() const override { return bounds_; }
  float area() const override {
    return area_up_to_.empty() ? 0 : static_cast<float>(area_up_to_.back());
  }
  const TriangleMesh* mesh() const override { return &mesh_; }
  std::uint32_t primitive_count() const override {
    return static_cast<std::uint32_t>(mesh_.triangles.size());
  }
  /// Selects a triangle with u.x and reuses the remainder of u.x within the triangle.
  ShapeSample sample(Vec2 u) const override;

 protected:
  /// Removes triangles without area. Throws InputError if a position is not finite; the message
  /// uses `name` for the shape.
  TriangleShape(TriangleMesh mesh, const std::string& name);

  /// Returns the point of `triangle` with the barycentric weights `b`, and the density of sample().
  ShapeSample sample_at(std::uint32_t triangle, Vec2 b) const {
    return {.point = mesh_.surface_point(triangle, b.x, b.y), .pdf = 1 / area()};
  }

 private:
  TriangleMesh mesh_;
  Bounds3 bounds_;
  std::vector<double> area_up_to_;  ///< running sums of the areas, including each triangle [scene
                                    ///< units^2]
};

/// Transforms `local` to world space. The outer side remains the outer side under maps that mirror;
/// `flip_normals` exchanges the sides.
TriangleMesh transformed(TriangleMesh local, const Transform& to_world, bool flip_normals);

/// Throws InputError if a shape would have more triangles than an index or the memory of a large
/// machine can hold; the message uses `name` for the shape.
void check_triangle_count(double count, const std::string& name);

}  // namespace pharos

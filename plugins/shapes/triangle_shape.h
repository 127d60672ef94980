#pragma once

#include <string>
#include <vector>

#include <pharos/core/transform.h>
#include <pharos/scene/shape.h>

namespace pharos {

/// Base of the shapes that are made of triangles.
class TriangleShape : public Shape {
 public:
  Bounds3 bounds() const override { return bounds_; }
  float area() const override { return static_cast<float>(area_up_to_.back()); }
  const TriangleMesh* mesh() const override { return &mesh_; }
  std::uint32_t primitive_count() const override {
    return static_cast<std::uint32_t>(mesh_.triangles.size());
  }
  /// Picks a triangle with u.x, whose remainder then serves within it.
  ShapeSample sample(Vec2 u) const override;

 protected:
  /// Leaves out triangles without area. Throws InputError when none is left or a position is not
  /// finite; `name` stands for the shape there.
  TriangleShape(TriangleMesh mesh, const std::string& name);

  /// The point of `triangle` at barycentric weights `b`, with the density of sample().
  ShapeSample sample_at(std::uint32_t triangle, Vec2 b) const {
    return {.point = mesh_.surface_point(triangle, b.x, b.y), .pdf = 1 / area()};
  }

 private:
  TriangleMesh mesh_;
  Bounds3 bounds_;
  std::vector<double> area_up_to_;  ///< of the triangles up to and with each [scene units^2]
};

/// Takes `local` to world space. The outer side stays the outer side under maps that mirror;
/// `flip_normals` exchanges the sides.
TriangleMesh transformed(TriangleMesh local, const Transform& to_world, bool flip_normals);

/// Throws InputError when a shape would be made of more triangles than an index or the memory of a
/// large machine can hold; `name` stands for the shape there.
void check_triangle_count(double count, const std::string& name);

}  // namespace pharos

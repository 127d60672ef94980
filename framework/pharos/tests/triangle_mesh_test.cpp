// The surface at a point of a triangle: position and its error bound, normals, coordinates.

#include <doctest/doctest.h>

#include <pharos/core/warp.h>
#include <pharos/scene/shape.h>

#include "scene_fixtures.h"

namespace pharos {
namespace {

TriangleMesh one_triangle(Point3 a, Point3 b, Point3 c) {
  TriangleMesh mesh;
  mesh.positions = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// Returns the signed distance of a point from the plane of the triangle, in double precision.
double plane_distance(const TriangleMesh& mesh, Point3 p) {
  using Row = std::array<double, 3>;
  const auto minus = [](Point3 a, Point3 b) {
    return Row{double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
  };
  const Row u = minus(mesh.positions[1], mesh.positions[0]);
  const Row v = minus(mesh.positions[2], mesh.positions[0]);
  const Row n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const Row d = minus(p, mesh.positions[0]);
  return (d[0] * n[0] + d[1] * n[1] + d[2] * n[2]) / std::hypot(n[0], n[1], n[2]);
}

TEST_CASE("positions lie on the triangle's plane within a fraction of the stated error") {
  RandomStream random(1);
  for (const float offset : {0.0f, 1.0f, 1000.0f}) {
    for (int i = 0; i < 2000; ++i) {
      const auto corner = [&] {
        return Point3{offset, -offset, offset} + test::random_direction(random);
      };
      const TriangleMesh mesh = one_triangle(corner(), corner(), corner());
      if (mesh.area(0) < 0.05f) continue;
      const SurfacePoint p = mesh.surface_point(0, 0.3f, 0.4f);
      CHECK(std::abs(plane_distance(mesh, p.position)) < 0.5 * p.error);
      const double off = plane_distance(mesh, p.origin_towards(p.normal));
      CHECK(off > 0.5 * p.error);
      CHECK(off < 1.5 * p.error);
      CHECK(plane_distance(mesh, p.origin_towards(-p.normal)) < -0.5 * p.error);
    }
  }
}

TEST_CASE("positions keep twice the stated error away from edges, and do not move elsewhere") {
  const TriangleMesh mesh = one_triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  const SurfacePoint inner = mesh.surface_point(0, 0.25f, 0.25f);
  CHECK(inner.position == Point3{1, 0.75f, 0});
  for (const Vec2 b : {Vec2{0.5f, 0}, Vec2{0, 0.5f}, Vec2{0.5f, 0.5f}, Vec2{1e-7f, 0.3f},
                       Vec2{0.3f, -1e-7f}, Vec2{0, 0}, Vec2{0.5f, 0.50000012f}}) {
    const SurfacePoint p = mesh.surface_point(0, b.x, b.y);
    const float enough = 1.98f * p.error;
    CHECK(p.position.x >= enough);
    CHECK(p.position.y >= enough);
    CHECK((12 - 3 * p.position.x - 4 * p.position.y) / 5 >= enough);
    CHECK(length(p.position - Point3{4 * b.x, 3 * b.y, 0}) < 4 * p.error);
    CHECK(p.position.z == 0);
  }
}

TEST_CASE("positions keep a margin from both edges of a corner, however sharp") {
  constexpr float margin = 1e-3f;
  for (const float degrees : {1.0f, 5.0f, 17.0f, 60.0f, 120.0f, 170.0f}) {
    const float angle = degrees * kPi / 180;
    const Vec3 side{std::cos(angle), std::sin(angle), 0};
    const TriangleMesh mesh = one_triangle({0, 0, 0}, {1, 0, 0}, {side.x, side.y, 0});
    RandomStream random(1);
    for (int i = 0; i < 1000; ++i) {
      const float scale = std::exp2(-20 * random.next_1d());
      const Vec2 b = scale * warp::triangle_from_square(random.next_2d());
      const Point3 p = mesh.position_off_edges(0, b.x, b.y, margin);
      CAPTURE(degrees);
      CAPTURE(p.x);
      CHECK(p.y > 0.999f * margin);
      CHECK(side.y * p.x - side.x * p.y > 0.999f * margin);
      CHECK(p.z == 0);
    }
  }
}

TEST_CASE("a triangle narrower than twice the error keeps its points inside") {
  const TriangleMesh mesh = one_triangle({1000, 0, 0}, {1001, 0, 0}, {1000, 1e-5f, 0});
  const SurfacePoint p = mesh.surface_point(0, 0.1f, 0.1f);
  CHECK(p.error > 1e-4f);
  CHECK(p.position.y >= 0);
  CHECK(p.position.y <= 1e-5f);
}

TEST_CASE("normals follow the winding, however small the triangle") {
  for (const float scale : {1e-18f, 1e-12f, 1.0f, 1e12f}) {
    const TriangleMesh mesh = one_triangle({0, 0, 0}, {0, scale, 0}, {0, 0, scale});
    CHECK(mesh.surface_point(0, 0.3f, 0.3f).normal == Vec3{1, 0, 0});
    CHECK(mesh.area(0) == doctest::Approx(scale * scale / 2));
  }
}

TEST_CASE("shading normals are interpolated and turned to the geometric side") {
  TriangleMesh mesh = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.normals = {{0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}};
  SurfacePoint p = mesh.surface_point(0, 0.25f, 0.25f);
  const Vec3 expected = normalize({0.5f * 0.6f - 0.25f * 0.6f, 0.25f * 0.6f, 0.8f});
  CHECK(length(p.shading.n - expected) < 1e-6f);
  for (Vec3& n : mesh.normals) n = -n;
  p = mesh.surface_point(0, 0.25f, 0.25f);
  CHECK(length(p.shading.n - expected) < 1e-6f);
  CHECK(p.normal == Vec3{0, 0, 1});
  CHECK(std::abs(dot(p.shading.s, p.shading.n)) < 1e-6f);
}

TEST_CASE("normals that cancel out or lie in the plane give way to the geometric one") {
  TriangleMesh mesh = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (const Vec3 n : {Vec3{0, 0, 0}, Vec3{1, 0, 0}}) {
    mesh.normals = {n, n, n};
    CHECK(mesh.surface_point(0, 0.25f, 0.25f).shading.n == Vec3{0, 0, 1});
  }
}

TEST_CASE("texture coordinates are interpolated, or barycentric where there are none") {
  TriangleMesh mesh = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK(mesh.surface_point(0, 0.25f, 0.5f).uv == Vec2{0.25f, 0.5f});
  mesh.uvs = {{1, 0}, {3, 0}, {1, 4}};
  CHECK(mesh.surface_point(0, 0.25f, 0.5f).uv == Vec2{1.5f, 2});
}

TEST_CASE("densities over area and over solid angle convert into each other") {
  const Point3 from{1, 2, 3}, point{4, 6, 3};  // their distance is 5
  const Vec3 normal = normalize({-3, -4, 5});  // at 45 degrees
  const float pdf = solid_angle_pdf_from_area(2, from, point, normal);
  CHECK(pdf == doctest::Approx(2 * 25 / std::sqrt(0.5)));
  CHECK(area_pdf_from_solid_angle(pdf, from, point, normal) == doctest::Approx(2));
  CHECK(solid_angle_pdf_from_area(2, from, point, {0, 0, 1}) == 0);
  CHECK(solid_angle_pdf_from_area(2, from, from, normal) == 0);
  CHECK(area_pdf_from_solid_angle(2, from, from, normal) == 0);
}

}  // namespace
}  // namespace pharos

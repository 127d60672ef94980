// Tangents of triangles and the frames made from them.

#include <limits>

#include <doctest/doctest.h>

#include "scene_fixtures.h"

namespace pharos {
namespace {

TEST_CASE("a triangle's tangents take texture coordinates to positions") {
  TriangleMesh mesh = test::square_at(0);
  mesh.uvs = {{0.1f, 0.2f}, {0.7f, 0.3f}, {0.4f, 0.9f}, {-0.5f, 0.8f}};
  for (const std::uint32_t i : {0u, 1u}) {
    const UvTangents tangents = mesh.uv_tangents(i);
    const auto corner = mesh.triangles[i];
    for (const std::size_t k : {1u, 2u}) {
      const Vec2 change = mesh.uvs[corner[k]] - mesh.uvs[corner[0]];
      const Vec3 edge = mesh.positions[corner[k]] - mesh.positions[corner[0]];
      CHECK(length(change.x * tangents.du + change.y * tangents.dv - edge) < 1e-5f);
    }
  }
}

TEST_CASE("a triangle without texture coordinates has those of its weights") {
  const TriangleMesh mesh = test::square_at(0);
  const UvTangents tangents = mesh.uv_tangents(1);
  CHECK(tangents.du == Vec3{2, 2, 0});
  CHECK(tangents.dv == Vec3{0, 2, 0});
}

TEST_CASE("texture coordinates without area give no tangents") {
  TriangleMesh mesh = test::square_at(0);
  mesh.uvs = {{0, 0}, {1, 1}, {2, 2}, {0.5f, 0.5f}};
  CHECK(mesh.uv_tangents(0).du == Vec3{});
  CHECK(mesh.uv_tangents(0).dv == Vec3{});
  SceneParts parts = test::parts_of({mesh});
  parts.objects[0].bsdf = std::make_shared<test::BrushedBsdf>();
  const Scene scene(std::move(parts));
  SurfacePoint p;
  REQUIRE(scene.intersect({{0.3f, 0.1f, 1}, {0, 0, -1}}, p) < kInfinity);
  CHECK(p.shading.s == Frame::from_normal(p.shading.n).s);
}

TEST_CASE("frames along a tangent") {
  const Vec3 n = normalize(Vec3{1, 2, -3});
  for (const float scale : {1e-30f, 1.0f, 1e30f}) {
    const Frame f = Frame::along(n, scale * Vec3{0.3f, -0.4f, 1});
    CHECK(length(f.s) == doctest::Approx(1));
    CHECK(std::abs(dot(f.s, n)) < 1e-6f);
    CHECK(length(cross(f.s, f.t) - n) < 1e-6f);
    CHECK(dot(f.s, Vec3{0.3f, -0.4f, 1}) > 0);
    CHECK(std::abs(dot(f.t, Vec3{0.3f, -0.4f, 1})) < 1e-6f);
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3 useless : {Vec3{}, Vec3{nan, 0, 1}, Vec3{kInfinity, 0, 0}}) {
    CHECK(Frame::along(n, useless).s == Frame::from_normal(n).s);
  }
}

}  // namespace
}  // namespace pharos

#include "../front_side.h"

#include <cmath>
#include <memory>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>

#include "../area.h"
#include "ceiling.h"

namespace pharos {
namespace {

class Triangles final : public Shape {
 public:
  explicit Triangles(TriangleMesh mesh) : mesh_(std::move(mesh)) { mesh_.precompute(); }

  Bounds3 bounds() const override { return mesh_.bounds(); }
  float area() const override { return 1; }
  const TriangleMesh* mesh() const override { return &mesh_; }
  ShapeSample sample(Vec2 u) const override {
    const auto count = static_cast<float>(mesh_.triangles.size());
    const auto triangle = static_cast<std::uint32_t>(u.x * count);
    const float x = u.x * count - static_cast<float>(triangle);
    return {mesh_.surface_point(triangle, x * u.y, x * (1 - u.y)), 1};
  }

 private:
  TriangleMesh mesh_;
};

/// Returns a square of two triangles with half the edge `size`; the fourth corner is bent off the
/// plane by `bend`.
Triangles square_at(Point3 center, const Frame& frame, float size, float bend = 0) {
  TriangleMesh mesh;
  for (const Vec3 corner : {Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}, Vec3{-1, 1, bend}}) {
    mesh.positions.push_back(center + size * frame.to_world(corner));
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return Triangles(std::move(mesh));
}

/// Returns a square of 2 * `count`^2 triangles with half the edge `size`.
Triangles grid_at(Point3 center, const Frame& frame, float size, std::uint32_t count) {
  TriangleMesh mesh;
  const float step = 2 / static_cast<float>(count);
  for (std::uint32_t i = 0; i <= count; ++i) {
    for (std::uint32_t j = 0; j <= count; ++j) {
      const Vec3 at{step * static_cast<float>(i) - 1, step * static_cast<float>(j) - 1, 0};
      mesh.positions.push_back(center + size * frame.to_world(at));
      const std::uint32_t corner = i * (count + 1) + j, above = corner + count + 1;
      if (i == count || j == count) continue;
      mesh.triangles.push_back({corner, above, above + 1});
      mesh.triangles.push_back({corner, above + 1, corner + 1});
    }
  }
  return Triangles(std::move(mesh));
}

/// Returns whether a point of the outer side of the shape faces `from`, as area lights decide it.
bool faces(const Shape& shape, Point3 from, Vec2 u) {
  const SurfacePoint p = shape.sample(u).point;
  return dot(normalize(from - p.position), p.normal) > 0;
}

TEST_CASE("no point of the outer side faces an excluded place") {
  RandomStream random(3);
  int excluded = 0, wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    const Frame frame = Frame::from_normal(warp::sphere_from_square(random.next_2d()));
    const Vec2 xy = random.next_2d();
    const Point3 center = (i % 2 == 0 ? 1.0f : 1000.0f) * Vec3{xy.x, xy.y, random.next_1d()};
    const Triangles square = square_at(center, frame, 0.5f);
    const FrontSide front(square);
    // From a distance of 1e-7 behind the plane to a distance of 10.
    const float depth = std::pow(10.0f, -7 + 8 * random.next_1d());
    const Vec2 aside = random.next_2d();
    const Point3 from = center + frame.to_world({20 * aside.x - 10, 20 * aside.y - 10, -depth});
    if (!front.excludes(from)) continue;
    ++excluded;
    for (int k = 0; k < 20; ++k) wrong += faces(square, from, random.next_2d()) ? 1 : 0;
  }
  CHECK(excluded > 800);
  CHECK(wrong == 0);
}

TEST_CASE("no place just behind a finely tessellated mesh sees a point of its outer side") {
  RandomStream random(4);
  int excluded = 0, wrong = 0;
  for (int i = 0; i < 300; ++i) {
    const Frame frame = Frame::from_normal(warp::sphere_from_square(random.next_2d()));
    const Point3 center = 100 * warp::sphere_from_square(random.next_2d());
    const Triangles grid = grid_at(center, frame, 50, 12);
    const FrontSide front(grid);
    for (int k = 0; k < 100; ++k) {
      const Vec2 aside = random.next_2d();
      const float depth = std::pow(10.0f, -7 + 6 * random.next_1d());
      const Point3 from = center + frame.to_world({100 * aside.x - 50, 100 * aside.y - 50, -depth});
      if (!front.excludes(from)) continue;
      ++excluded;
      for (int n = 0; n < 10; ++n) wrong += faces(grid, from, random.next_2d()) ? 1 : 0;
    }
  }
  CHECK(excluded > 3000);
  CHECK(wrong == 0);
}

TEST_CASE("an area light is not sampled from excluded places, and has no density there") {
  const Triangles square = square_at({}, Frame{}, 1);
  const AreaEmitter emitter({.radiance = std::make_shared<const OneColor>(Rgb(1))});
  const std::unique_ptr<const Light> light = emitter.place({.shape = &square});
  const SurfacePoint p = square.sample({0.3f, 0.4f}).point;
  const Point3 behind{0.2f, 0.1f, -1}, before{0.2f, 0.1f, 1};
  CHECK(light->sample(behind, {0.3f, 0.4f}).pdf == 0);
  CHECK(light->pdf_point(behind, p) == 0);
  CHECK(light->sample(before, {0.3f, 0.4f}).pdf > 0);
  CHECK(light->pdf_point(before, p) > 0);
}

TEST_CASE("places behind a flat shape are excluded, places before it are not") {
  const Frame frame = Frame::from_normal(normalize(Vec3{1, 2, -1}));
  const Triangles square = square_at({3, 4, 5}, frame, 2);
  const FrontSide front(square);
  for (const float aside : {0.0f, 1.0f, 30.0f}) {
    const auto place = [&](float height) {
      return Point3{3, 4, 5} + frame.to_world({aside, -aside, height});
    };
    CHECK(front.excludes(place(-0.01f)));
    CHECK(front.excludes(place(-100)));
    CHECK_FALSE(front.excludes(place(0)));
    CHECK_FALSE(front.excludes(place(0.01f)));
    CHECK_FALSE(front.excludes(place(100)));
  }
}

TEST_CASE("a bent shape excludes no place") {
  const FrontSide front(square_at({}, Frame{}, 1, 0.01f));
  CHECK_FALSE(front.excludes({0, 0, -5}));
  CHECK_FALSE(front.excludes({0, 0, 5}));
}

}  // namespace
}  // namespace pharos

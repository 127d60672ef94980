#include "../cylinder.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "shape_test_kit.h"

namespace pharos {
namespace {

const Cylinder::Settings kTube{.p0 = {0, 0, 1}, .p1 = {0, 0, 4}, .radius = 2};

/// Returns the distance from the axis of a tube along z, in double precision.
double axis_distance(Point3 p, Point3 axis = {}) {
  return std::hypot(double{p.x} - axis.x, double{p.y} - axis.y);
}

TEST_CASE("a ray meets a tube where the formula says, grazing too") {
  const auto scene = test::scene_of<Cylinder>(kTube);
  for (const float height : {0.0f, 1.0f, 1.9f, 1.99999f, 1.9999999f}) {
    SurfacePoint p;
    const float t = scene->intersect({{-5, height, 2.5f}, {1, 0, 0}}, p);
    CHECK(t == doctest::Approx(5 - std::sqrt(4.0 - double{height} * height)).epsilon(1e-6));
    CHECK(std::abs(axis_distance(p.position) - 2) <= p.error);
    CHECK(p.position.z == 2.5f);
    CHECK(p.normal.y == doctest::Approx(height / 2));
    CHECK(p.uv.y == doctest::Approx(0.5));
  }
  CHECK_FALSE(scene->occluded({{-5, 2.0000005f, 2}, {1, 0, 0}}));
  CHECK(scene->occluded({{-5, 1.9999995f, 2}, {1, 0, 0}}));
}

TEST_CASE("a tube is open and hit from both sides") {
  const auto scene = test::scene_of<Cylinder>(kTube);
  SurfacePoint p;
  CHECK(scene->intersect({{0, 0, 2}, {0, 1, 0}}, p) == doctest::Approx(2));
  CHECK(p.normal.y == 1);
  CHECK_FALSE(scene->occluded({{0.5f, 0, -5}, {0, 0, 1}}));  // along the axis, through both ends
  CHECK_FALSE(scene->occluded({{2, 0, 0.5f}, {0, 0, 1}}));   // along the surface itself
  CHECK_FALSE(scene->occluded({{-5, 0, 0.999f}, {1, 0, 0}}));
  CHECK_FALSE(scene->occluded({{-5, 0, 4.001f}, {1, 0, 0}}));
  CHECK_FALSE(scene->occluded({{-5, 0, 2}, {1, 0, 0}, 2.999f}));
  // The ray enters through the end at p1, passes the near wall and hits the inner side of the far
  // wall.
  const Vec3 d = normalize(Vec3{1, 0, -1});
  CHECK(scene->intersect({{-2.5f, 0, 6}, d}, p) == doctest::Approx(4.5 * std::sqrt(2.0)));
  CHECK(p.position.x == doctest::Approx(2));
  CHECK(p.position.z == doctest::Approx(1.5));
  CHECK(dot(p.normal, d) > 0);
}

TEST_CASE("hits on a thin tube far away lie on it, and all that its samples promise is seen") {
  const Cylinder::Settings settings{.p0 = {1e5f, -2e5f, 5e4f}, .p1 = {1e5f, -2e5f, 5.01e4f}};
  const Cylinder tube(settings);
  const auto scene = test::scene_of<Cylinder>(settings);
  RandomStream random(1);
  const Point3 from{3, 4, 5};
  int missed = 0;
  for (int i = 0; i < 10'000; ++i) {
    const ShapeSample s = tube.sample_from(from, random.next_2d());
    CHECK(std::abs(axis_distance(s.point.position, settings.p0) - 1) <= s.point.error);
    SurfacePoint p;
    const Vec3 d = normalize(s.point.position - from);
    if (scene->intersect({from, d}, p) == kInfinity) {
      // Directions are floats: 1e-7 of the distance is 2 % of the radius at the silhouette.
      CHECK((abs_dot(d, s.point.normal) < 0.3f || std::abs(s.point.uv.y - 0.5f) > 0.499f));
      ++missed;
      continue;
    }
    CHECK(std::abs(axis_distance(p.position, settings.p0) - 1) <= p.error);
  }
  CHECK(missed < 600);
}

TEST_CASE("texture coordinates of a tube are azimuth and height in local space") {
  const Transform turned = Transform::rotate({0, 1, 0}, 90);  // local z becomes x, x becomes -z
  const Cylinder::Settings settings{.p0 = {0, 0, -1}, .p1 = {0, 0, 3}, .to_world = turned};
  const auto scene = test::scene_of<Cylinder>(settings);
  SurfacePoint p;
  scene->intersect({{2, 5, 0}, {0, -1, 0}}, p);
  CHECK(p.uv.x == doctest::Approx(0.25));
  CHECK(p.uv.y == doctest::Approx(0.75));
  scene->intersect({{2, -5, 0}, {0, 1, 0}}, p);
  CHECK(p.uv.x == doctest::Approx(0.75));
  scene->intersect({{0, 0.001f, -5}, {0, 0, 1}}, p);
  CHECK(p.uv.x == doctest::Approx(0).epsilon(1e-3));
  CHECK(p.uv.y == doctest::Approx(0.25));
  Cylinder::Settings mirrored = settings;
  mirrored.to_world = Transform::scale({1, -1, 1}) * turned;
  const auto mirror = test::scene_of<Cylinder>(mirrored);
  mirror->intersect({{2, -5, 0}, {0, 1, 0}}, p);
  CHECK(p.uv.x == doctest::Approx(0.25));
}

TEST_CASE("the area of a tube is 2 pi r h") {
  CHECK(Cylinder(kTube).area() == doctest::Approx(2 * kPi * 2 * 3));
  Cylinder::Settings scaled = kTube;
  scaled.to_world = Transform::rotate({1, 2, 3}, 50) * Transform::scale({3, -3, 3});
  CHECK(Cylinder(scaled).area() == doctest::Approx(2 * kPi * 2 * 3 * 9));
}

TEST_CASE("samples of any tube are hit where they lie, within its bounds") {
  const Cylinder::Settings settings{
      .p0 = {1, -2, 0.5f},
      .p1 = {-0.3f, 0.4f, 2},
      .radius = 0.7f,
      .to_world = Transform::rotate({3, -1, 2}, 70) * Transform::scale({2, -2, 2})};
  const Cylinder tube(settings);
  const auto scene = test::scene_of<Cylinder>(settings);
  RandomStream random(2);
  for (int i = 0; i < 2000; ++i) {
    const SurfacePoint s = tube.sample(random.next_2d()).point;
    CHECK(tube.bounds().contains(s.position));
    SurfacePoint p;
    const float t = scene->intersect({s.position + 0.5f * s.normal, -s.normal}, p);
    CHECK(t == doctest::Approx(0.5));
    CHECK(length(p.position - s.position) < 1e-5f);
    CHECK(dot(p.normal, s.normal) == doctest::Approx(1));
    CHECK(p.uv.x == doctest::Approx(s.uv.x).epsilon(1e-4));
    CHECK(p.uv.y == doctest::Approx(s.uv.y).epsilon(1e-4));
  }
}

TEST_CASE(
    "points of a tube keep their error away from its ends, and flipped normals face the axis") {
  Cylinder::Settings settings = kTube;
  settings.flip_normals = true;
  const Cylinder tube(settings);
  for (const float end : {0.0f, kOneMinusEpsilon}) {
    const SurfacePoint p = tube.sample({0.3f, end}).point;
    CHECK(p.position.z >= 1 + 0.9f * p.error);
    CHECK(p.position.z <= 4 - 0.9f * p.error);
    CHECK(p.uv.y == doctest::Approx(end));
    CHECK(dot(p.normal, Vec3{p.position.x, p.position.y, 0}) == doctest::Approx(-2));
    CHECK(dot(p.shading.n, p.normal) == doctest::Approx(1));
  }
}

TEST_CASE("tubes that cannot be are refused") {
  CHECK_THROWS_AS(Cylinder(Cylinder::Settings{.p0 = {1, 2, 3}, .p1 = {1, 2, 3}}), InputError);
  CHECK_THROWS_AS(Cylinder(Cylinder::Settings{.to_world = Transform::scale({1, 1, 2})}),
                  InputError);
  CHECK_THROWS_AS(Cylinder(Cylinder::Settings{.radius = 1e38f}), InputError);
}

}  // namespace
}  // namespace pharos

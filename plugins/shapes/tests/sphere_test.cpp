#include "../sphere.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "shape_test_kit.h"

namespace pharos {
namespace {

double distance(Point3 a, Point3 b) {
  const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

TEST_CASE("a ray meets a sphere where the formula says, grazing too") {
  const auto scene = test::scene_of<Sphere>({.radius = 2});
  for (const float height : {0.0f, 1.0f, 1.9f, 1.99999f, 1.9999999f}) {
    SurfacePoint p;
    const float t = scene->intersect({{-5, height, 0}, {1, 0, 0}}, p);
    const double half_chord = std::sqrt(4.0 - double{height} * height);
    CHECK(t == doctest::Approx(5 - half_chord).epsilon(1e-6));
    CHECK(std::abs(distance(p.position, {}) - 2) <= p.error);
    CHECK(p.normal.y == doctest::Approx(height / 2));
  }
  CHECK_FALSE(scene->occluded({{-5, 2.0000005f, 0}, {1, 0, 0}}));
  CHECK(scene->occluded({{-5, 1.9999995f, 0}, {1, 0, 0}}));
}

TEST_CASE("a ray sees only what lies before its end") {
  const auto scene = test::scene_of<Sphere>({.radius = 2});
  SurfacePoint p;
  CHECK(scene->intersect({{-5, 0, 0}, {1, 0, 0}, 2.999f}, p) == kInfinity);
  CHECK(scene->intersect({{-5, 0, 0}, {1, 0, 0}, 3.001f}, p) == doctest::Approx(3));
  CHECK(scene->intersect({{0, 0, 0}, {1, 0, 0}}, p) == doctest::Approx(2));
  CHECK_FALSE(scene->occluded({{3, 0, 0}, {1, 0, 0}}));
}

TEST_CASE("hits on a small sphere far away lie on it, and all that its samples promise is seen") {
  const Sphere::Settings settings{.center = {1e5f, -2e5f, 5e4f}};
  const Sphere sphere(settings);
  const auto scene = test::scene_of<Sphere>(settings);
  RandomStream random(1);
  const Point3 from{3, 4, 5};
  int missed = 0;
  for (int i = 0; i < 10'000; ++i) {
    const ShapeSample s = sphere.sample_from(from, random.next_2d());
    const Vec3 d = normalize(s.point.position - from);
    CHECK(dot(d, s.point.normal) <= 0.01f);
    CHECK(std::abs(distance(s.point.position, settings.center) - 1) <= s.point.error);
    SurfacePoint p;
    if (scene->intersect({from, d}, p) == kInfinity) {
      ++missed;
      continue;
    }
    CHECK(std::abs(distance(p.position, settings.center) - 1) <= p.error);
    CHECK(sphere.pdf_from(from, p) == s.pdf);
  }
  CHECK(missed < 200);  // directions are floats: 1e-7 of 2e5 is 2 % of the radius
}

TEST_CASE("texture coordinates are longitude and latitude in local space") {
  const Transform turned = Transform::rotate({0, 1, 0}, 90);  // local z becomes x
  const auto scene = test::scene_of<Sphere>({.to_world = turned});
  SurfacePoint p;
  scene->intersect({{5, 0, 0}, {-1, 0, 0}}, p);
  CHECK(p.uv.y == doctest::Approx(0).epsilon(1e-3));
  scene->intersect({{0, 5, 0}, {0, -1, 0}}, p);  // local y
  CHECK(p.uv.x == doctest::Approx(0.25));
  CHECK(p.uv.y == doctest::Approx(0.5));
  scene->intersect({{0, -5, 0}, {0, 1, 0}}, p);
  CHECK(p.uv.x == doctest::Approx(0.75));
}

TEST_CASE("to_world may rotate, mirror and scale evenly, and nothing else") {
  Sphere::Settings settings{.center = {1, 0, 0}, .radius = 2};
  settings.to_world = Transform::rotate({0, 0, 1}, 90) * Transform::scale({3, -3, 3});
  const Sphere sphere(settings);
  CHECK(sphere.area() == doctest::Approx(4 * kPi * 36));
  CHECK(sphere.bounds().center().y == doctest::Approx(3));
  CHECK(sphere.sample({0.3f, 0.3f}).point.error > 0);
  settings.to_world = Transform::scale({1, 1, 1.01f});
  CHECK_THROWS_AS(Sphere{settings}, InputError);
  settings.to_world = Transform({{{1, 0.1f, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  CHECK_THROWS_AS(Sphere{settings}, InputError);
}

TEST_CASE("flipped normals point to the center, shading normals with them") {
  const Sphere sphere(Sphere::Settings{.flip_normals = true});
  RandomStream random(5);
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint p = sphere.sample(random.next_2d()).point;
    CHECK(dot(p.normal, p.position) < -0.999f);
    CHECK(dot(p.shading.n, p.normal) == doctest::Approx(1));
  }
}

TEST_CASE("scaling by a power of two scales every hit exactly") {
  const Sphere::Settings one{.center = {0.3f, 1.7f, -2.1f}, .radius = 1.3f};
  const auto scene = test::scene_of<Sphere>(one);
  for (const float scale : {0x1p-14f, 0x1p13f}) {
    const auto scaled =
        test::scene_of<Sphere>({.center = scale * one.center, .radius = scale * one.radius});
    RandomStream random(2);
    for (int i = 0; i < 5000; ++i) {
      const Point3 origin = 4 * test::random_direction(random);
      const Vec3 d = normalize(one.center + 1.5f * test::random_direction(random) - origin);
      SurfacePoint p, q;
      const float t = scene->intersect({origin, d}, p);
      REQUIRE(scaled->intersect({scale * origin, d}, q) == scale * t);
      if (t == kInfinity) continue;
      CHECK(q.position == scale * p.position);
      CHECK(q.error == scale * p.error);
      CHECK(q.normal == p.normal);
      CHECK(q.origin_towards(d) == scale * p.origin_towards(d));
    }
  }
}

}  // namespace
}  // namespace pharos

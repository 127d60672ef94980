#include "../disk.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "shape_test_kit.h"

namespace pharos {
namespace {

Transform sheared() {
  return Transform({{{1.5f, 0.4f, 0.2f, 0.3f}, {0, 0.8f, -0.3f, 1}, {0.1f, 0.2f, 1.1f, -2}}});
}

TEST_CASE("a ray meets a disk within its rim") {
  const auto scene = test::scene_of<Disk>({.to_world = Transform::scale({2, 2, 2})});
  SurfacePoint p;
  for (const float x : {0.0f, 1.3f, -1.999f}) {
    CHECK(scene->intersect({{x, 0, 3}, {0, 0, -1}}, p) == doctest::Approx(3));
    CHECK(p.position.x == doctest::Approx(x));
    CHECK(p.position.z == 0);
    CHECK(p.normal == Vec3{0, 0, 1});
    CHECK(p.uv.x == doctest::Approx(0.25f * (x + 2)));
    CHECK(p.uv.y == doctest::Approx(0.5));
  }
  CHECK(scene->occluded({{1.41f, 1.41f, -3}, {0, 0, 1}}));
  CHECK_FALSE(scene->occluded({{1.42f, 1.42f, -3}, {0, 0, 1}}));
  CHECK_FALSE(scene->occluded({{2.001f, 0, 3}, {0, 0, -1}}));
  CHECK_FALSE(scene->occluded({{0, 0, 3}, {0, 0, -1}, 2.999f}));
  CHECK_FALSE(scene->occluded({{0, 0, 3}, {0, 0, 1}}));
}

TEST_CASE("rays within the plane of a disk pass it") {
  const auto scene = test::scene_of<Disk>({});
  CHECK_FALSE(scene->occluded({{-3, 0, 0}, {1, 0, 0}}));
  CHECK_FALSE(scene->occluded({{0, 0, 0}, {1, 0, 0}}));
}

TEST_CASE("a disk under any affine map is the ellipse it should be") {
  for (const float mirror : {1.0f, -1.0f}) {
    for (const bool flip : {false, true}) {
      const Transform map = sheared() * Transform::scale({mirror, 1, 1});
      const Disk disk(Disk::Settings{.to_world = map, .flip_normals = flip});
      const auto scene = test::scene_of<Disk>({.to_world = map, .flip_normals = flip});
      const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0});
      CHECK(disk.area() == doctest::Approx(kPi * length(cross(x, y))));
      const Vec3 outer = normalize(map.normal({0, 0, flip ? -1.0f : 1.0f}));
      RandomStream random(4);
      for (int i = 0; i < 300; ++i) {
        const Vec2 local{3 * random.next_1d() - 1.5f, 3 * random.next_1d() - 1.5f};
        const Point3 target = map.point({local.x, local.y, 0});
        const Point3 from = target + test::random_direction(random);
        const Vec3 d = normalize(target - from);
        if (abs_dot(d, outer) < 0.05f) continue;
        const float radius = std::hypot(local.x, local.y);
        if (std::abs(radius - 1) < 1e-4f) continue;
        SurfacePoint p;
        const bool hit = scene->intersect({from, d}, p) < kInfinity;
        CHECK(hit == (radius < 1));
        if (!hit) continue;
        CHECK(length(p.position - target) < 1e-5f);
        CHECK(dot(p.normal, outer) == doctest::Approx(1));
        CHECK(disk.bounds().contains(p.position));
      }
    }
  }
}

TEST_CASE("the area of a disk is pi r^2") {
  CHECK(Disk(Disk::Settings{}).area() == doctest::Approx(kPi));
  CHECK(Disk(Disk::Settings{.to_world = Transform::scale({3, 3, 1})}).area() ==
        doctest::Approx(9 * kPi));
}

TEST_CASE("points of a disk keep their error away from the rim") {
  const Transform map = Transform::translate({300, 0, 0}) * Transform::scale({0.01f, 1, 1});
  const Disk disk(Disk::Settings{.to_world = map});
  const auto scene = test::scene_of<Disk>({.to_world = map});
  const float x = std::nextafter(1.0f, 0.0f);
  SurfacePoint p;
  scene->intersect({map.point({0, x, 2}), {0, 0, -1}}, p);
  CHECK(1 - p.position.y >= 0.9f * p.error);
  CHECK(1 - p.position.y <= 200 * p.error);  // the short radius is 100 times shorter
  CHECK(p.uv.y == doctest::Approx(1));
}

TEST_CASE("hits on a small disk far away lie on it") {
  const Point3 center{1e5f, -2e5f, 5e4f};
  const auto scene = test::scene_of<Disk>({.to_world = Transform::translate(center)});
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const Point3 from = center + 100 * test::random_direction(random);
    const Vec3 d = normalize(center - from);
    SurfacePoint p;
    if (std::abs(d.z) < 0.1f) continue;
    REQUIRE(scene->intersect({from, d}, p) < kInfinity);
    CHECK(std::abs(p.position.z - center.z) <= p.error);
  }
}

TEST_CASE("disks that floats cannot hold are refused") {
  CHECK_THROWS_AS(Disk(Disk::Settings{.to_world = Transform::scale({1e25f, 1e25f, 1})}),
                  InputError);
  CHECK_THROWS_AS(Disk(Disk::Settings{.to_world = Transform::scale({1e-25f, 1e-25f, 1})}),
                  InputError);
}

}  // namespace
}  // namespace pharos

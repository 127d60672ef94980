#include "../orthographic.h"

#include <doctest/doctest.h>

#include <pharos/config/registry.h>
#include <pharos/core/random.h>

namespace pharos {
namespace {

TEST_CASE("rays are parallel and evenly spaced over the width, upright and not mirrored") {
  // In a view along +y with +z up, +x is on the right.
  const Transform to_world = Transform::look_at({1, 2, 3}, {1, 7, 3}, {0, 0, 1});
  const OrthographicSensor camera({.to_world = to_world, .width = 8});
  CHECK(camera.position() == Point3{1, 2, 3});
  const auto sensor = camera.prepare(200, 100);
  const LensPoint lens = sensor->sample_lens({0.3f, 0.9f});
  CHECK(lens.position == Point3{1, 2, 3});
  for (const Vec2 film : {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{0.75f, 0.25f}, Vec2{1, 1}}) {
    const Ray ray = sensor->ray(lens, film);
    CHECK(length(ray.direction - Vec3{0, 1, 0}) < 1e-6f);
    const Point3 expected{1 + 8 * (film.x - 0.5f), 2, 3 - 4 * (film.y - 0.5f)};
    CHECK(length(ray.origin - expected) < 1e-5f);
  }
}

TEST_CASE("maps that scale and shear the view keep its rays parallel to their local z") {
  const Transform stretched({{{2, 0.3f, 0.1f, 1}, {0, -1.5f, 0.4f, 2}, {0.2f, 0, 0.7f, 3}}});
  const auto sensor = OrthographicSensor({.to_world = stretched, .width = 3}).prepare(64, 48);
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec2 film = random.next_2d();
    const Ray ray = sensor->ray(sensor->sample_lens(random.next_2d()), film);
    CHECK(length(ray.direction) == doctest::Approx(1));
    CHECK(length(cross(ray.direction, stretched.vector({0, 0, 1}))) < 1e-6f);
    const Point3 local = stretched.inverse_point(ray.origin);
    CHECK(length(local - Point3{3 * (0.5f - film.x), 2.25f * (0.5f - film.y), 0}) < 1e-5f);
  }
}

TEST_CASE("there is no density over directions, and guides are told") {
  const OrthographicSensor camera({});
  CHECK(camera.sees_one_direction());
  const auto sensor = camera.prepare(2, 2);
  CHECK_FALSE(sensor->response(sensor->sample_lens({}), {0, 0, 1}));
}

TEST_CASE("a view without width is refused") {
  Registry registry;
  registry.add<OrthographicSensor>("orthographic", "");
  BuildContext context{registry};
  ConfigNode resolved;
  const ConfigNode flat = parse_yaml("{ type: orthographic, width: 0 }", "a.yaml");
  CHECK_THROWS_AS(registry.build<Sensor>(flat, context, resolved), InputError);
}

}  // namespace
}  // namespace pharos

#include "../perspective.h"

#include <doctest/doctest.h>

#include <pharos/core/random.h>

namespace pharos {
namespace {

Transform looking_along_y() {
  return Transform::look_at({1, 2, 3}, {1, 7, 3}, {0, 0, 1});
}

std::unique_ptr<const PreparedSensor> camera(float fov, int width, int height,
                                             const Transform& to_world = looking_along_y()) {
  return PerspectiveSensor({.to_world = to_world, .fov = fov}).prepare(width, height);
}

Ray ray_at(const PreparedSensor& sensor, Vec2 film) {
  return sensor.ray(sensor.sample_lens({}), film);
}

TEST_CASE("the image is upright and not mirrored") {
  // In a view along +y with +z up, +x is on the right.
  const auto sensor = camera(90, 200, 100);
  const Ray center = ray_at(*sensor, {0.5f, 0.5f});
  CHECK(center.origin == Point3{1, 2, 3});
  CHECK(center.direction.y == doctest::Approx(1));
  const Vec3 right = ray_at(*sensor, {kOneMinusEpsilon, 0.5f}).direction;
  CHECK(right.x == doctest::Approx(std::sqrt(0.5)));  // half of 90 degrees
  CHECK(right.y == doctest::Approx(std::sqrt(0.5)));
  const Vec3 top = ray_at(*sensor, {0.5f, 0}).direction;
  CHECK(top.z / top.y == doctest::Approx(0.5));  // half the width
  CHECK(PerspectiveSensor({.to_world = looking_along_y()}).position() == Point3{1, 2, 3});
  CHECK(dot(sensor->sample_lens({}).normal, Vec3{0, 1, 0}) == doctest::Approx(1));
}

TEST_CASE("response undoes ray, also under maps that stretch and shear") {
  const Transform stretched({{{2, 0.3f, 0.1f, 1}, {0, -1.5f, 0.4f, 2}, {0.2f, 0, 0.7f, 3}}});
  for (const Transform& to_world : {looking_along_y(), stretched}) {
    const auto sensor = camera(65, 64, 48, to_world);
    const LensPoint lens = sensor->sample_lens({0.3f, 0.6f});
    RandomStream random(1);
    for (int i = 0; i < 1000; ++i) {
      const Vec2 film{0.001f + 0.998f * random.next_1d(), 0.001f + 0.998f * random.next_1d()};
      const Ray ray = sensor->ray(lens, film);
      CHECK(length(ray.direction) == doctest::Approx(1));
      const auto response = sensor->response(lens, ray.direction);
      REQUIRE(response);
      CHECK(response->film.x == doctest::Approx(film.x).epsilon(1e-4));
      CHECK(response->film.y == doctest::Approx(film.y).epsilon(1e-4));
    }
  }
}

TEST_CASE("directions off the film have no response") {
  const auto sensor = camera(90, 100, 100);
  const LensPoint lens = sensor->sample_lens({});
  CHECK(sensor->response(lens, normalize({0.99f, 1, 0.99f})));
  CHECK_FALSE(sensor->response(lens, normalize({1.01f, 1, 0})));
  CHECK_FALSE(sensor->response(lens, normalize({0, 1, -1.01f})));
  CHECK_FALSE(sensor->response(lens, {0, -1, 0}));
  CHECK_FALSE(sensor->response(lens, {1, 0, 0}));
}

TEST_CASE("the mean of 1 / direction_pdf over the film is the solid angle of the frustum") {
  for (const float fov : {5.0f, 60.0f, 150.0f}) {
    const auto sensor = camera(fov, 160, 90);
    const LensPoint lens = sensor->sample_lens({});
    constexpr int count = 200;
    double sum = 0;
    for (int i = 0; i < count * count; ++i) {
      const Vec2 film{(i % count + 0.5f) / count, (i / count + 0.5f) / count};
      sum += 1 / sensor->response(lens, sensor->ray(lens, film).direction)->direction_pdf;
    }
    const double a = std::tan(radians(fov) / 2.0), b = a * 90 / 160;
    const double pyramid = 4 * std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b)));
    CHECK(sum / (count * count) == doctest::Approx(pyramid).epsilon(1e-3));
  }
}

TEST_CASE("direction_pdf is the density of directions, by area of small film patches") {
  const Transform stretched({{{2, 0.3f, 0.1f, 1}, {0, -1.5f, 0.4f, 2}, {0.2f, 0, 0.7f, 3}}});
  for (const Transform& to_world : {looking_along_y(), stretched}) {
    const auto sensor = camera(80, 100, 100, to_world);
    const LensPoint lens = sensor->sample_lens({});
    for (const Vec2 film : {Vec2{0.5f, 0.5f}, Vec2{0.1f, 0.8f}, Vec2{0.95f, 0.05f}}) {
      constexpr float h = 1.0f / 256;
      const Vec3 dx = sensor->ray(lens, film + Vec2{h, 0}).direction -
                      sensor->ray(lens, film - Vec2{h, 0}).direction;
      const Vec3 dy = sensor->ray(lens, film + Vec2{0, h}).direction -
                      sensor->ray(lens, film - Vec2{0, h}).direction;
      const float solid_angle = length(cross(dx, dy)) / (4 * h * h);
      const auto response = sensor->response(lens, sensor->ray(lens, film).direction);
      CHECK(response->direction_pdf == doctest::Approx(1 / solid_angle).epsilon(2e-3));
    }
  }
}

}  // namespace
}  // namespace pharos

#include "../point.h"

#include <doctest/doctest.h>

namespace pharos {

TEST_CASE("point: intensity over the square of the distance") {
  const PointEmitter emitter({.intensity = {3, 1, 0},
                              .position = {0, 0, 2},
                              .to_world = Transform::translate({1, 0, 0}),
                              .scale = 2});
  CHECK_FALSE(emitter.needs_shape());
  const auto light = emitter.place({});
  const LightSample s = light->sample({1, 3, -2}, {0.2f, 0.8f});
  CHECK(s.distance == doctest::Approx(5));
  CHECK(length(s.direction - Vec3{0, -0.6f, 0.8f}) < 1e-6f);
  CHECK(s.radiance.r == doctest::Approx(6.0 / 25));
  CHECK(s.radiance.g == doctest::Approx(2.0 / 25));
  CHECK(s.pdf == 1);
  CHECK(s.discrete);
  CHECK(s.kind == VertexKind::light);
  CHECK(s.point.position == Point3{1, 0, 2});
  CHECK(dot(s.point.normal, s.direction) == doctest::Approx(-1));
}

TEST_CASE("point: power") {
  const PointEmitter emitter({.intensity = {3, 1, 2}});
  CHECK(emitter.place({})->power() == doctest::Approx(4 * kPi * 2));
  CHECK_FALSE(emitter.place({})->is_environment());
}

TEST_CASE("point: nothing at the light itself") {
  const PointEmitter emitter({.intensity = Rgb(1), .position = {1, 2, 3}});
  CHECK(emitter.place({})->sample({1, 2, 3}, {}).pdf == 0);
  const PointEmitter dark({.intensity = Rgb(0)});
  CHECK(dark.place({})->sample({1, 2, 3}, {}).pdf == 0);
}

}  // namespace pharos

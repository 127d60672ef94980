#include "../constant.h"

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>

namespace pharos {
namespace {

std::unique_ptr<const Light> sky(float radius = 1) {
  const ConstantEmitter emitter({.radiance = {1, 2, 3}, .scale = 2});
  CHECK_FALSE(emitter.needs_shape());
  return emitter.place({.scene_center = {5, 0, 0}, .scene_radius = radius});
}

TEST_CASE("directions follow the density that is claimed for them") {
  const auto light = sky();
  const auto fit = statistics::fit_direction_density(
      [&](RandomStream& random) -> std::optional<Vec3> {
        return light->sample({}, random.next_2d()).direction;
      },
      [&](Vec3 direction) -> double { return light->pdf_direction(direction); },
      {.draws = 40'000, .cells = 60});
  CHECK(fit.chi_square.p_value > 1e-4);
  CHECK(fit.integral == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("samples carry the same radiance and density as rays that leave the scene") {
  const auto light = sky(4);
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const Point3 from{10 * random.next_1d(), 0, -3};
    const LightSample s = light->sample(from, random.next_2d());
    CHECK(s.radiance == Rgb(2, 4, 6));
    CHECK(s.radiance == light->environment_radiance(s.direction));
    CHECK(s.pdf == light->pdf_direction(s.direction));
    CHECK(s.distance == kInfinity);
    CHECK(s.kind == VertexKind::environment);
    CHECK(length(s.point.position - Point3{5, 0, 0}) >
          4);  // the sample's point is outside the scene
    CHECK(dot(s.point.normal, s.direction) == doctest::Approx(-1));
  }
}

TEST_CASE("power is what enters the scene's sphere") {
  const auto light = sky(3);
  CHECK(light->power() == doctest::Approx(kPi * 4 * (4 * kPi * 9)));
  CHECK(light->is_environment());
}

}  // namespace
}  // namespace pharos

#include "../sun.h"

#include <numbers>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/tests/fixtures.h>

#include "../preetham.h"

namespace pharos {
namespace {

SunEmitter::Settings settings(Vec3 sun, float radius_scale = 1) {
  SunEmitter::Settings s;
  s.sun_direction = sun;
  s.radius_scale = radius_scale;
  return s;
}

struct Sun {
  SunEmitter emitter;
  std::unique_ptr<const Light> light;

  explicit Sun(const SunEmitter::Settings& s)
      : emitter(s), light(emitter.place({.scene_center = {5, 0, 0}, .scene_radius = 2})) {}

  /// The radiance seen `degrees` beside the center of a sun at (0, 1, 1).
  Rgb beside(float degrees) const {
    const float angle = radians(45 + degrees);
    return light->environment_radiance({0, std::sin(angle), std::cos(angle)});
  }
};

}  // namespace

TEST_CASE("sun: a disk of its radius and radiance") {
  const Sun sun(settings({0, 1, 1}));
  const Rgb expected = preetham_sun_radiance(3, std::numbers::pi / 4);
  CHECK(sun.beside(0).g == doctest::Approx(expected.g).epsilon(1e-4));
  CHECK(sun.beside(0.267f).b == doctest::Approx(expected.b).epsilon(1e-4));
  CHECK(sun.beside(-0.267f).r == doctest::Approx(expected.r).epsilon(1e-4));
  CHECK(is_black(sun.beside(0.269f)));
  CHECK(is_black(sun.beside(-0.269f)));
  CHECK(is_black(sun.beside(180)));
}

TEST_CASE("sun: samples are those of a ray that runs into the disk, and add up to the irradiance") {
  const Sun exact(settings({0, 1, 1}, 0));
  const LightSample parallel = exact.light->sample({}, {0.5f, 0.5f});
  CHECK(parallel.discrete);
  CHECK_FALSE(exact.light->is_environment());
  CHECK(length(parallel.direction - normalize(Vec3{0, 1, 1})) < 1e-6f);
  for (const float scale : {0.01f, 1.0f, 50.0f}) {
    CAPTURE(scale);
    const Sun sun(settings({0, 1, 1}, scale));
    RandomStream random(2);
    Rgb sum;
    int missed = 0;
    constexpr int kDraws = 4000;
    for (int i = 0; i < kDraws; ++i) {
      const LightSample s = sun.light->sample({1, 2, 3}, random.next_2d());
      CHECK(s.radiance == sun.light->environment_radiance(s.direction));
      CHECK(s.pdf == sun.light->pdf_direction(s.direction));
      CHECK(s.distance == kInfinity);
      missed += s.pdf > 0 ? 0 : 1;
      if (s.pdf > 0) sum += s.radiance / s.pdf;
    }
    CHECK(missed <= 4);  // on the rim, by rounding
    CHECK(sum.g / kDraws == doctest::Approx(parallel.radiance.g).epsilon(2e-3));
    CHECK(sun.light->power() == doctest::Approx(exact.light->power()));
  }
}

TEST_CASE("sun: directions are uniform in the cone") {
  const Sun sun(settings({1, 1, 0.3f}, 60));
  const auto fit = statistics::fit_direction_density(
      [&](RandomStream& random) -> std::optional<Vec3> {
        return sun.light->sample({}, random.next_2d()).direction;
      },
      [&](Vec3 d) -> double { return sun.light->pdf_direction(d); },
      {.draws = 40'000, .cells = 100, .quadrature_tolerance = 3e-4});
  CHECK(fit.chi_square.p_value > 1e-4);
  CHECK(fit.integral == doctest::Approx(1).epsilon(1e-2));
  CHECK(fit.outside_support == 0);
}

TEST_CASE("sun: stretch moves it with the sky, to_world turns up, scale counts") {
  SunEmitter::Settings stretched = settings({0, 1, 1});
  stretched.stretch = 2;
  stretched.scale = 3;
  const Sun sun(stretched);
  const Rgb expected = preetham_sun_radiance(3, std::numbers::pi / 4);
  CHECK(sun.light->environment_radiance({0, 0, 1}).g ==
        doctest::Approx(3 * expected.g).epsilon(1e-4));
  SunEmitter::Settings z_up = settings({0, 0, 1});
  z_up.to_world = Transform::rotate({1, 0, 0}, 90);
  CHECK(Sun(z_up).light->environment_radiance({0, 0, 1}).g ==
        doctest::Approx(preetham_sun_radiance(3, 0).g).epsilon(1e-4));
  CHECK(test::input_error([] {
          SunEmitter{settings({0, -1, 1})};
        }) == "sun: the sun is 45 degrees below the horizon; the model ends there");
}

}  // namespace pharos

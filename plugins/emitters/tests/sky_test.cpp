#include "../sky.h"

#include <numbers>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>
#include <pharos/tests/fixtures.h>

#include "../hosek_wilkie.h"
#include "../preetham.h"

namespace pharos {
namespace {

SkyEmitter::Settings settings(float turbidity, Vec3 sun, int resolution = 512) {
  SkyEmitter::Settings s;
  s.turbidity = turbidity;
  s.sun_direction = sun;
  s.resolution = resolution;
  return s;
}

struct Sky {
  SkyEmitter emitter;
  std::unique_ptr<const Light> light;

  explicit Sky(const SkyEmitter::Settings& s)
      : emitter(s), light(emitter.place({.scene_center = {5, 0, 0}, .scene_radius = 2})) {}

  Rgb seen(Vec3 direction) const { return light->environment_radiance(normalize(direction)); }
};

/// Compares the light with `radiance(zenith, gamma)` in directions that are not close to the sun.
/// Next to the sun, the radiance changes within a pixel.
template <class Model>
void check_shows(const Sky& sky, const Model& model, Vec3 sun) {
  RandomStream random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = LatLong::direction(random.next_1d(), 0.48 * random.next_1d());
    const double gamma = std::acos(std::clamp(dot(d, sun), -1.0f, 1.0f));
    if (gamma < 0.05) continue;
    const Rgb expected = model.radiance(std::acos(d.y), gamma);
    for (int c = 0; c < 3; ++c) {
      CHECK(sky.seen(d)[c] == doctest::Approx(expected[c]).epsilon(0.02));
    }
  }
  CHECK(is_black(sky.seen({0.3f, -0.1f, 0.2f})));
  CHECK(is_black(sky.seen({0, -1, 0})));
}

}  // namespace

TEST_CASE("sky: every direction shows the model, within a pixel") {
  const double sun_zenith = std::numbers::pi / 3;
  const Vec3 sun{0, static_cast<float>(std::cos(sun_zenith)),
                 static_cast<float>(std::sin(sun_zenith))};
  SkyEmitter::Settings s = settings(3, sun);
  s.ground = {0.1f, 0.5f, 0.2f};
  check_shows(Sky(s), HosekWilkieSky(3, s.ground, sun_zenith), sun);
  s.model = SkyModel::preetham;
  check_shows(Sky(s), PreethamSky(3, sun_zenith), sun);
}

TEST_CASE("sky: the same to both sides of the sun's meridian") {
  const Sky sky(settings(2.5f, {0.6f, 0.5f, 0}));
  for (const Vec3 d : {Vec3{1, 1, 1}, Vec3{-0.2f, 0.1f, 0.9f}, Vec3{0.5f, 0.02f, 0.1f}}) {
    const Rgb left = sky.seen(d), right = sky.seen({d.x, d.y, -d.z});
    for (int c = 0; c < 3; ++c) CHECK(left[c] == doctest::Approx(right[c]).epsilon(1e-4));
    CHECK(luminance(sky.seen({std::abs(d.x), d.y, d.z})) >
          luminance(sky.seen({-std::abs(d.x), d.y, d.z})));
  }
}

TEST_CASE("sky: to_world says where up is, the sun stays where it is in the world") {
  SkyEmitter::Settings z_up = settings(3, {0, 1, 2});
  z_up.to_world = Transform::rotate({1, 0, 0}, 90);
  z_up.scale = 2;
  const Sky sky(z_up), y_up(settings(3, {0, 2, -1}));
  // The rotation takes +y to +z and -z to +y.
  CHECK(sky.seen({0, 1, 2}).g == doctest::Approx(2 * y_up.seen({0, 2, -1}).g).epsilon(1e-3));
  CHECK(sky.seen({1, 0, 0.5f}).r == doctest::Approx(2 * y_up.seen({1, 0.5f, 0}).r).epsilon(1e-3));
  CHECK(is_black(sky.seen({0, 1, -0.5f})));
  SkyEmitter::Settings sheared;
  sheared.to_world = Transform::scale({1, 2, 1});
  CHECK(test::input_error([&] { SkyEmitter{sheared}; }) ==
        "sky: 'to_world' must scale evenly and not shear");
}

TEST_CASE("sky: stretch takes the horizon further down") {
  SkyEmitter::Settings stretched = settings(3, {0, 1, 0});
  stretched.stretch = 2;
  const Sky sky(stretched), plain(settings(3, {0, 1, 0}));
  CHECK(luminance(sky.seen({1, -1, 0})) > 0);
  CHECK(sky.seen({1, 0, 0}).g == doctest::Approx(plain.seen({1, 1, 0}).g).epsilon(1e-3));
}

TEST_CASE("sky: directions follow the density, and the ground's irradiance is its quadrature") {
  for (const Vec3 sun : {Vec3{0, 1, 0}, Vec3{1, 0.7f, 0}, Vec3{1, 0.05f, 0.2f}}) {
    for (const float turbidity : {2.0f, 8.0f}) {
      SkyEmitter::Settings s = settings(turbidity, sun, 128);
      s.model = turbidity < 5 ? SkyModel::hosek_wilkie : SkyModel::preetham;
      const Sky sky(s);
      const auto fit = statistics::fit_direction_density(
          [&](RandomStream& random) -> std::optional<Vec3> {
            return sky.light->sample({}, random.next_2d()).direction;
          },
          [&](Vec3 d) -> double { return sky.light->pdf_direction(d); },
          {.draws = 40'000, .cells = 100, .quadrature_tolerance = 3e-4});
      CHECK(fit.chi_square.p_value > 1e-4);
      CHECK(fit.integral == doctest::Approx(1).epsilon(2e-3));
      const auto on_ground = [&](Vec3 d) -> double {
        return std::max(0.0f, d.y) * sky.light->environment_radiance(d).g;
      };
      const double exact =
          statistics::integrate_sphere(on_ground, {.tolerance = 1e-5}, 64, 64).value;
      double sum = 0, squares = 0;
      constexpr int kDraws = 20'000;
      RandomStream random(5);
      for (int i = 0; i < kDraws; ++i) {
        const LightSample s = sky.light->sample({}, random.next_2d());
        const double value = std::max(0.0f, s.direction.y) * s.radiance.g / s.pdf;
        sum += value, squares += value * value;
      }
      const double found = sum / kDraws;
      const double error = std::sqrt((squares / kDraws - found * found) / kDraws);
      CHECK(std::abs(found - exact) < 4 * error + 1e-3 * exact);
      CHECK(error < 0.01 * exact);
    }
  }
}

TEST_CASE("sky: on a clear day the ground gets 10 to 40 klx from it") {
  // Measured skies give about 15 klx. Preetham's model is known to be too bright (Zotti, Wilkie and
  // Purgathofer 2007, "A Critical Review of the Preetham Skylight Model").
  const auto lux = [](SkyModel model) {
    SkyEmitter::Settings s = settings(2.5f, {0.5f, 1, 0}, 128);
    s.model = model;
    const Sky sky(s);
    const auto on_ground = [&](Vec3 d) -> double {
      return std::max(0.0f, d.y) * luminance(sky.light->environment_radiance(d));
    };
    return 683 * 106.857 *
           statistics::integrate_sphere(on_ground, {.tolerance = 1e-5}, 64, 64).value;
  };
  const double by_hosek_wilkie = lux(SkyModel::hosek_wilkie), by_preetham = lux(SkyModel::preetham);
  CHECK(by_hosek_wilkie > 10'000);
  CHECK(by_hosek_wilkie < by_preetham);
  CHECK(by_preetham < 40'000);
}

}  // namespace pharos

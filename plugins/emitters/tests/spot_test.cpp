#include "../spot.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "axial_integral.h"

namespace pharos {
namespace {

/// A light at (0, 0, 1) that shines along +x.
std::unique_ptr<const Light> spot(const SpotEmitter::Settings& settings) {
  SpotEmitter::Settings moved = settings;
  moved.to_world = Transform::look_at({0, 0, 1}, {3, 0, 1}, {0, 0, 1});
  return SpotEmitter(moved).place({});
}

/// The radiance of the sample at distance 1 and at an angle in degrees from the axis.
double at_angle(const Light& light, double degrees) {
  const double angle = degrees * 3.14159265358979 / 180;
  const Point3 from{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 1};
  return light.sample(from, {}).radiance.r;
}

}  // namespace

TEST_CASE("spot: linear falloff from the beam's edge to the cutoff") {
  const auto light = spot({.intensity = Rgb(8), .cutoff_angle = 25, .beam_width = 15});
  CHECK(at_angle(*light, 0) == doctest::Approx(8));
  CHECK(at_angle(*light, 14.9) == doctest::Approx(8));
  CHECK(at_angle(*light, 20) == doctest::Approx(4).epsilon(1e-4));
  CHECK(at_angle(*light, 22.5) == doctest::Approx(2).epsilon(1e-4));
  CHECK(at_angle(*light, 25.1) == 0);
  CHECK(at_angle(*light, 180) == 0);
}

TEST_CASE("spot: smooth falloff in the cosine") {
  const auto light = spot(
      {.intensity = Rgb(8), .cutoff_angle = 90, .beam_width = 0, .falloff = SpotFalloff::smooth});
  CHECK(at_angle(*light, 60) == doctest::Approx(4));
  const double t = std::cos(0.5);
  CHECK(at_angle(*light, 0.5 * 180 / 3.14159265358979) ==
        doctest::Approx(8 * t * t * (3 - 2 * t)).epsilon(1e-4));
}

TEST_CASE("spot: narrow beams keep their falloff") {
  for (const float cutoff : {0.1f, 0.01f}) {
    CAPTURE(cutoff);
    const auto light = spot({.intensity = Rgb(8),
                             .cutoff_angle = cutoff,
                             .beam_width = cutoff / 2,
                             .falloff = SpotFalloff::smooth});
    for (const double share : {0.51, 0.6, 0.75, 0.9, 0.99}) {
      // The cosine of small angles is 1 - angle^2 / 2.
      const double t = (1 - share * share) / (1 - 0.25);
      CHECK(at_angle(*light, share * double{cutoff}) ==
            doctest::Approx(8 * t * t * (3 - 2 * t)).epsilon(5e-3));
    }
  }
}

TEST_CASE("spot: power of narrow beams") {
  const double cutoff = 0.001 * 3.14159265358979 / 180, square = cutoff * cutoff;
  const auto power = [](SpotFalloff falloff) {
    return SpotEmitter({.cutoff_angle = 0.001f, .beam_width = 0, .falloff = falloff})
        .place({})
        ->power();
  };
  // Series in the angle for 2 pi (1 - sin c / c) and 2 pi (1 - (1 + cos c) / 2).
  CHECK(power(SpotFalloff::linear) ==
        doctest::Approx(2 * 3.14159265358979 * square / 6).epsilon(1e-4));
  CHECK(power(SpotFalloff::smooth) ==
        doctest::Approx(2 * 3.14159265358979 * square / 4).epsilon(1e-4));
}

TEST_CASE("spot: sampled like a point") {
  const auto light = spot({.intensity = {8, 4, 2}, .scale = 0.5f});
  const LightSample s = light->sample({2, 0, 1}, {0.1f, 0.9f});
  CHECK(s.radiance == Rgb(1, 0.5f, 0.25f));
  CHECK(s.distance == doctest::Approx(2));
  CHECK(s.direction.x == doctest::Approx(-1));
  CHECK(s.discrete);
  CHECK(s.pdf == 1);
  CHECK(s.kind == VertexKind::light);
  CHECK(light->sample({-2, 0, 1}, {}).pdf == 0);  // behind the light
}

TEST_CASE("spot: power is the integral of intensity") {
  for (const SpotEmitter::Settings& settings :
       {SpotEmitter::Settings{.intensity = {6, 3, 0}},
        {.cutoff_angle = 25, .beam_width = 25},
        {.cutoff_angle = 180, .beam_width = 180},
        {.cutoff_angle = 120, .beam_width = 0},
        {.cutoff_angle = 70, .beam_width = 10, .falloff = SpotFalloff::smooth},
        {.cutoff_angle = 30, .beam_width = 30, .falloff = SpotFalloff::smooth}}) {
    const auto light = SpotEmitter(settings).place({});
    const double exact = axial_integral([&](double angle) -> double {
      const Point3 from{static_cast<float>(std::sin(angle)), 0,
                        static_cast<float>(std::cos(angle))};
      return mean(light->sample(from, {}).radiance);
    });
    CHECK(light->power() == doctest::Approx(exact).epsilon(1e-4));
  }
}

TEST_CASE("spot: the beam must fit into the cone") {
  CHECK_THROWS_WITH_AS(SpotEmitter({.cutoff_angle = 10}),
                       "spot: 'beam_width' must be at most 'cutoff_angle', got 15 and 10",
                       InputError);
}

}  // namespace pharos

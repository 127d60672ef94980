#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "../henyey_greenstein.h"
#include "../isotropic.h"
#include "../rayleigh.h"

namespace pharos {
namespace {

constexpr Vec3 kBack{0, 0, -1};  // towards the start of the path, which travels along +z

Vec3 at_angle(double t) {
  return {static_cast<float>(std::sin(t)), 0, static_cast<float>(std::cos(t))};
}

double henyey_greenstein(double g, double t) {
  return (1 - g * g) / (4 * 3.14159265358979 * std::pow(1 + g * g - 2 * g * std::cos(t), 1.5));
}

TEST_CASE("henyey_greenstein has its closed form, in narrow lobes too") {
  for (const float g : {0.0f, 0.3f, -0.6f, 0.9f, 0.98f, -0.98f, 0.999f}) {
    const HenyeyGreensteinPhase phase({.g = g});
    for (const double t : {0.0, 1e-4, 1e-3, 0.03, 0.5, 1.6, 3.0, 3.14, 3.1415}) {
      CAPTURE(g);
      CAPTURE(t);
      const auto expected = doctest::Approx(henyey_greenstein(g, t)).epsilon(1e-4).scale(0);
      CHECK(phase.evaluate(kBack, at_angle(t)) == expected);
    }
  }
}

TEST_CASE("henyey_greenstein's draws have the mean cosine g and know both ends") {
  for (const float g : {0.0f, 0.5f, -0.9f, 0.98f}) {
    const HenyeyGreensteinPhase phase({.g = g});
    CHECK(phase.mean_cosine() == g);
    RandomStream random(5);
    constexpr int kDraws = 200'000;
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) sum += phase.sample(kBack, random.next_2d()).z;
    CHECK(std::abs(sum / kDraws - g) < 0.005);
    const float forwards = g >= 0 ? 1.0f : -1.0f;
    if (g != 0) CHECK(phase.sample(kBack, {0, 0.3f}).z == doctest::Approx(forwards));
    const Vec3 last = phase.sample(kBack, {0.9999999f, 0.3f});
    CHECK(length(last) == doctest::Approx(1));
    if (g != 0) CHECK(last.z == doctest::Approx(-forwards).epsilon(0.01));
  }
}

TEST_CASE("rayleigh scatters twice as much ahead as aside; its distribution is inverted") {
  const RayleighPhase phase;
  CHECK(phase.evaluate(kBack, {0, 0, 1}) == doctest::Approx(2 * phase.evaluate(kBack, {1, 0, 0})));
  for (const float u : {0.0f, 0.01f, 0.3f, 0.5f, 0.77f, 0.999999f}) {
    const double c = phase.sample(kBack, {u, 0.2f}).z;
    CHECK((c * c * c + 3 * c + 4) / 8 == doctest::Approx(u).epsilon(1e-5));
  }
}

TEST_CASE("isotropic is the same everywhere") {
  const IsotropicPhase phase;
  CHECK(phase.evaluate(kBack, {1, 0, 0}) == doctest::Approx(1 / (4 * kPi)));
}

}  // namespace
}  // namespace pharos

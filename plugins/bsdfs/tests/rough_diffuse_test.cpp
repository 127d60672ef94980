#include "../rough_diffuse.h"

#include <cmath>

#include <doctest/doctest.h>

#include "../diffuse.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

RoughDiffuse rough(float alpha, Rgb reflectance, bool fast = false) {
  return RoughDiffuse({.reflectance = test::uniform(reflectance),
                       .alpha = test::uniform(Rgb(alpha)),
                       .use_fast_approx = fast});
}

}  // namespace

TEST_CASE("rough diffuse: without roughness it is diffuse") {
  const Rgb reflectance{0.2f, 0.5f, 0.8f};
  const Diffuse matt({.reflectance = test::uniform(reflectance)});
  for (const bool fast : {false, true}) {
    for (const double theta : {0.0, 40.0, 89.0}) {
      const Vec3 wo = test::direction(theta, 30), wi = test::direction(55, 110);
      const ScatterValue a = rough(0, reflectance, fast).evaluate({}, wo, wi, {});
      const ScatterValue b = matt.evaluate({}, wo, wi, {});
      for (int c = 0; c < 3; ++c) CHECK(a.value[c] == doctest::Approx(b.value[c]).epsilon(1e-6));
      CHECK(a.pdf == b.pdf);
    }
  }
}

TEST_CASE("rough diffuse: values of the published formulas") {
  // f for the angles 30 and 60 degrees, alpha 0.5 and reflectance 0.8, evaluated separately.
  const auto f = [](double azimuth, bool fast) {
    const Vec3 wo = test::direction(60, 10), wi = test::direction(30, 10 + azimuth);
    return rough(0.5f, Rgb(0.8f), fast).evaluate({}, wo, wi, {}).value.g / wi.z;
  };
  CHECK(f(40, false) == doctest::Approx(0.2609323).epsilon(1e-5));
  CHECK(f(40, true) == doctest::Approx(0.2451869).epsilon(1e-5));
  CHECK(f(150, false) == doctest::Approx(0.2107865).epsilon(1e-5));
  CHECK(f(150, true) == doctest::Approx(0.2196688).epsilon(1e-5));
}

TEST_CASE("rough diffuse: light between facets deepens the color") {
  const Vec3 wo = test::direction(20, 0), wi = test::direction(30, 180);
  const Rgb full = rough(0.7f, {0.9f, 0.3f, 0}).evaluate({}, wo, wi, {}).value;
  CHECK(full.r / full.g > 3.1);
  CHECK(full.b == 0);
  const Rgb fast = rough(0.7f, {0.9f, 0.3f, 0}, true).evaluate({}, wo, wi, {}).value;
  CHECK(fast.r / fast.g == doctest::Approx(3));
}

TEST_CASE("rough diffuse: reciprocal") {
  const Vec3 a = test::direction(75, 20), b = test::direction(35, 140);
  for (const bool fast : {false, true}) {
    const RoughDiffuse bsdf = rough(0.4f, Rgb(0.7f), fast);
    CHECK(bsdf.evaluate({}, a, b, {}).value.g / b.z ==
          doctest::Approx(bsdf.evaluate({}, b, a, {}).value.g / a.z));
  }
}

TEST_CASE("rough diffuse: a white surface gains up to four percent, one of 0.95 nothing") {
  double largest = 0;
  for (const float alpha : {0.1f, 0.4f, 0.7f, 1.0f}) {
    for (const double theta : {0.0, 60.0, 89.0}) {
      const Vec3 wo = test::direction(theta, 30);
      largest = std::max(largest, test::smooth_albedo(rough(alpha, Rgb(1)), wo));
      CHECK(test::smooth_albedo(rough(alpha, Rgb(0.95f)), wo) < 1);
      CHECK(test::smooth_albedo(rough(alpha, Rgb(0.95f), true), wo) < 1);
    }
  }
  CHECK(largest > 1.03);
  CHECK(largest < 1.045);
}

}  // namespace pharos

#include "../diffuse.h"

#include <doctest/doctest.h>

#include "bsdf_checks.h"

namespace pharos {

TEST_CASE("diffuse: Lambert's law") {
  const Diffuse bsdf({.reflectance = test::uniform({0.2f, 0.5f, 0.8f})});
  const SurfacePoint point;
  const Vec3 wo = test::direction(50, 0), wi = test::direction(60, 90);
  const ScatterValue v = bsdf.evaluate(point, wo, wi, {});
  CHECK(v.pdf == doctest::Approx(0.5 / M_PI));
  CHECK(v.value.g == doctest::Approx(0.5 * 0.5 / M_PI));
  CHECK(test::smooth_albedo(bsdf, wo) == doctest::Approx(0.5).epsilon(1e-4));
  CHECK(bsdf.albedo(point) == Rgb(0.2f, 0.5f, 0.8f));
  CHECK(bsdf.roughness(point) == 1);
  CHECK(bsdf.relative_ior() == 1);
}

TEST_CASE("diffuse: the weight is the reflectance") {
  const Diffuse bsdf({.reflectance = test::uniform({0.2f, 0.5f, 0.8f})});
  const auto s = bsdf.sample({}, test::direction(10, 0), 0.9f, {0.25f, 0.75f}, {});
  REQUIRE(s);
  CHECK(s->weight == Rgb(0.2f, 0.5f, 0.8f));
  CHECK(s->event == Event::smooth_reflect);
}

TEST_CASE("diffuse: the map of samples changes their density alone") {
  const Diffuse round({.reflectance = test::uniform(Rgb(0.6f))});
  const Diffuse straight(
      {.reflectance = test::uniform(Rgb(0.6f)), .warp = HemisphereWarp::octahedral});
  const Vec3 wo = test::direction(10, 0);
  for (const double theta : {20.0, 70.0}) {
    const Vec3 wi = test::direction(theta, 30);
    CHECK(straight.evaluate({}, wo, wi, {}).value == round.evaluate({}, wo, wi, {}).value);
    CHECK_FALSE(straight.evaluate({}, wo, wi, {}).pdf == round.evaluate({}, wo, wi, {}).pdf);
  }
  // The weight straight up is 0.6 / pi over 1/2.
  const auto up = straight.sample({}, wo, 0, {0.5f, 0.5f}, {});
  REQUIRE(up);
  CHECK(up->direction == Vec3{0, 0, 1});
  CHECK(up->weight.g == doctest::Approx(1.2 / M_PI));
}

}  // namespace pharos

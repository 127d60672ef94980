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

}  // namespace pharos

#include "../phong.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "bsdf_checks.h"

namespace pharos {
namespace {

Phong phong(Rgb diffuse, Rgb specular, float exponent, std::optional<float> rescale_to = {}) {
  return Phong({.diffuse_reflectance = test::uniform(diffuse),
                .specular_reflectance = test::uniform(specular),
                .exponent = test::uniform(Rgb(exponent)),
                .rescale_to = rescale_to});
}

}  // namespace

TEST_CASE("phong: the peak in closed form") {
  const Phong bsdf = phong(Rgb(0.3f), Rgb(0.6f), 10);
  const Vec3 wo = test::direction(60, 0), mirrored{-wo.x, -wo.y, wo.z};
  const ScatterValue v = bsdf.evaluate({}, wo, mirrored, {});
  CHECK(v.value.g == doctest::Approx(0.5 * (0.3 / M_PI + 0.6 * 12 / (2 * M_PI))));
  CHECK(v.pdf == doctest::Approx(0.5 / M_PI / 3 + 11 / (2 * M_PI) * 2 / 3));
  // 30 degrees from the mirror direction, in the plane of incidence.
  const Vec3 beside = test::direction(30, 180);
  CHECK(bsdf.evaluate({}, wo, beside, {}).value.g / beside.z ==
        doctest::Approx(0.3 / M_PI + 0.6 * 12 / (2 * M_PI) * std::pow(std::sqrt(0.75), 10)));
}

TEST_CASE("phong: reflects its shares at normal incidence, and no more elsewhere") {
  for (const float exponent : {0.0f, 1.0f, 10.0f, 200.0f}) {
    const Phong bsdf = phong(Rgb(0.3f), Rgb(0.7f), exponent);
    CHECK(test::smooth_albedo(bsdf, {0, 0, 1}) == doctest::Approx(1).epsilon(1e-3));
    for (const double theta : {30.0, 60.0, 85.0}) {
      CHECK(test::smooth_albedo(bsdf, test::direction(theta, 40)) < 1);
    }
  }
  CHECK(phong(Rgb(0.1f), Rgb(0.7f), 5).albedo({}).g == doctest::Approx(0.8));
}

TEST_CASE("phong: a narrow lobe keeps its digits") {
  // Weights are (n + 2) / (n + 1) cos(i), and their mean is the cosine of the mirror direction.
  const Phong bsdf = phong(Rgb(0), Rgb(1), 1e5f);
  const Vec3 wo = test::direction(50, 70);
  RandomStream random(5);
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto s = bsdf.sample({}, wo, 0, random.next_2d(), {});
    REQUIRE(s);
    CHECK(s->weight.g == doctest::Approx(double{s->direction.z}).epsilon(1e-3));
    sum += double{s->weight.g} / 1000;
  }
  CHECK(sum == doctest::Approx(double{wo.z}).epsilon(1e-3));
  CHECK(bsdf.roughness({}) == doctest::Approx(0.004472).epsilon(1e-3));
  CHECK(phong(Rgb(1), Rgb(0), 50).roughness({}) == 1);
}

TEST_CASE("phong: too large shares are scaled alike when asked") {
  const Phong scaled = phong({0.4f, 0.8f, 0}, {0.1f, 0.4f, 0.5f}, 20, 0.9f);
  const Phong same = phong({0.3f, 0.6f, 0}, {0.075f, 0.3f, 0.375f}, 20);
  const Vec3 wo = test::direction(40, 0), wi = test::direction(50, 170);
  const Rgb a = scaled.evaluate({}, wo, wi, {}).value, b = same.evaluate({}, wo, wi, {}).value;
  for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]));
  // Shares that are small enough are not scaled.
  CHECK(phong(Rgb(0.2f), Rgb(0.3f), 20, 0.9f).albedo({}).g == doctest::Approx(0.5));
}

}  // namespace pharos

// Rough metal and glass with different roughnesses along two directions.

#include <cmath>

#include <doctest/doctest.h>

#include "../rough_conductor.h"
#include "../rough_dielectric.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

constexpr auto kGgx = FacetDistribution::ggx, kBeckmann = FacetDistribution::beckmann;

RoughConductor metal(float alpha, std::optional<float> alpha_v,
                     FacetDistribution distribution = kGgx) {
  return RoughConductor({.alpha = alpha,
                         .alpha_v = alpha_v,
                         .distribution = distribution,
                         .material = Metal::ideal,
                         .specular_reflectance = test::uniform(Rgb(1))});
}
RoughDielectric glass(float alpha, std::optional<float> alpha_v,
                      FacetDistribution distribution = kGgx) {
  return RoughDielectric({.alpha = alpha,
                          .alpha_v = alpha_v,
                          .distribution = distribution,
                          .specular_reflectance = test::uniform(Rgb(1)),
                          .specular_transmittance = test::uniform(Rgb(1))});
}

Vec3 turned(Vec3 v) {
  return {-v.y, v.x, v.z};
}

/// Smith's Lambda and the density D of anisotropic GGX in the forms of Heitz 2014, eqs. 72, 80 and
/// 85.
double lambda(Vec3 v, double ax, double ay) {
  const double a2 = (ax * ax * v.x * v.x + ay * ay * v.y * v.y) / (double{v.z} * v.z);
  return 0.5 * (std::sqrt(1 + a2) - 1);
}
double ggx(Vec3 m, double ax, double ay) {
  const double s = m.x * m.x / (ax * ax) + m.y * m.y / (ay * ay) + double{m.z} * m.z;
  return 1 / (M_PI * ax * ay * s * s);
}

}  // namespace

TEST_CASE("anisotropic GGX: the textbook formula") {
  const Vec3 wo = test::direction(35, 20), wi = test::direction(55, 130), m = normalize(wo + wi);
  const double ax = 0.5, ay = 0.2;
  const double expected =
      ggx(m, ax, ay) / (4 * wo.z * (1 + lambda(wo, ax, ay) + lambda(wi, ax, ay)));
  CHECK(metal(0.5f, 0.2f).evaluate({}, wo, wi, {}).value.g ==
        doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("brushed metal and glass: samples are those of the density") {
  for (const FacetDistribution d : {kGgx, kBeckmann}) {
    for (const double theta : {20.0, 75.0}) {
      const Vec3 wo = test::direction(theta, 30);
      CHECK(test::fit_smooth(metal(0.1f, 0.6f, d), wo, {}, 11).chi_square.p_value > 1e-3);
      CHECK(test::fit_smooth(glass(0.5f, 0.15f, d), wo, {}, 12).chi_square.p_value > 1e-3);
      test::check_samples(metal(0.1f, 0.6f, d), wo, {});
      test::check_samples(glass(0.5f, 0.15f, d), wo, {});
      test::check_samples(glass(0.5f, 0.15f, d), -wo, {});
    }
  }
}

TEST_CASE("brushed metal: one roughness stated twice is the isotropic metal, to the bit") {
  CHECK(metal(0.3f, {}).needs_tangents() == false);
  CHECK(metal(0.3f, 0.3f).needs_tangents() == false);
  CHECK(metal(0.3f, 0.1f).needs_tangents());
  const Vec3 wo = test::direction(35, 20), wi = test::direction(55, 130);
  const ScatterValue once = metal(0.3f, {}).evaluate({}, wo, wi, {});
  const ScatterValue twice = metal(0.3f, 0.3f).evaluate({}, wo, wi, {});
  CHECK(once.value == twice.value);
  CHECK(once.pdf == twice.pdf);
  // An isotropic metal does not change when both directions are rotated about the normal.
  const ScatterValue around = metal(0.3f, {}).evaluate({}, turned(wo), turned(wi), {});
  CHECK(around.value.g == doctest::Approx(once.value.g).epsilon(1e-5));
}

TEST_CASE("brushed metal and glass: exchanging the roughnesses is turning by a right angle") {
  const Vec3 wo = test::direction(35, 20);
  for (const FacetDistribution d : {kGgx, kBeckmann}) {
    for (const Vec3 wi : {test::direction(55, 130), test::direction(150, 190)}) {
      const ScatterValue a = glass(0.2f, 0.6f, d).evaluate({}, wo, wi, {});
      const ScatterValue b = glass(0.6f, 0.2f, d).evaluate({}, turned(wo), turned(wi), {});
      CHECK(a.value.g == doctest::Approx(b.value.g).epsilon(1e-5));
      CHECK(a.pdf == doctest::Approx(b.pdf).epsilon(1e-5));
      CHECK(a.value.g !=
            doctest::Approx(glass(0.6f, 0.2f, d).evaluate({}, wo, wi, {}).value.g).epsilon(1e-2));
    }
  }
}

TEST_CASE("brushed metal: smooth along u, it spreads light along v") {
  const RoughConductor brushed = metal(0.05f, 0.4f);
  const Vec3 wo{0, 0, 1};
  CHECK(brushed.evaluate({}, wo, test::direction(30, 90), {}).value.g >
        100 * brushed.evaluate({}, wo, test::direction(30, 0), {}).value.g);
  CHECK(brushed.roughness({}) == 0.05f);
}

}  // namespace pharos

#include "../ward.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "bsdf_checks.h"

namespace pharos {
namespace {

Ward glossy(float alpha_u, float alpha_v, WardVariant variant, float specular = 1) {
  return Ward({.alpha_u = alpha_u,
               .alpha_v = alpha_v,
               .specular_reflectance = test::uniform(Rgb(specular)),
               .diffuse_reflectance = test::uniform(Rgb(0)),
               .variant = variant});
}

constexpr WardVariant kVariants[] = {WardVariant::ward, WardVariant::ward_duer,
                                     WardVariant::balanced};

}  // namespace

TEST_CASE("ward: the textbook formulas, by the angles of the half vector") {
  const double au = 0.2, av = 0.5;
  const Vec3 wo = test::direction(50, 20), wi = test::direction(35, 170);
  const Vec3 h = wo + wi, m = normalize(h);
  const double delta = std::acos(double{m.z}), phi = std::atan2(double{m.y}, double{m.x});
  const double exponent = std::pow(std::tan(delta), 2) *
                          (std::pow(std::cos(phi) / au, 2) + std::pow(std::sin(phi) / av, 2));
  const double common = std::exp(-exponent) / (M_PI * au * av);
  const double product = double{wo.z} * wi.z;
  const double expected[] = {common / (4 * std::sqrt(product)), common / (4 * product),
                             common * length_squared(h) / std::pow(double{h.z}, 4)};
  for (const WardVariant variant : kVariants) {
    const ScatterValue v = glossy(0.2f, 0.5f, variant).evaluate({}, wo, wi, {});
    CHECK(v.value.g == doctest::Approx(wi.z * expected[static_cast<int>(variant)]).epsilon(1e-4));
  }
}

TEST_CASE("ward: with the base below it") {
  const Ward both({.specular_reflectance = test::uniform(Rgb(0.3f)),
                   .diffuse_reflectance = test::uniform({0.1f, 0.4f, 0.7f})});
  const Vec3 wo = test::direction(50, 20), wi = test::direction(5, 170);
  const Ward lobe = glossy(0.1f, 0.1f, WardVariant::balanced, 0.3f);
  const Rgb sum = lobe.evaluate({}, wo, wi, {}).value + Rgb(0.1f, 0.4f, 0.7f) * (wi.z / kPi);
  CHECK(both.evaluate({}, wo, wi, {}).value.b == doctest::Approx(sum.b).epsilon(1e-5));
  CHECK(both.evaluate({}, wo, wi, {}).value.r == doctest::Approx(sum.r).epsilon(1e-5));
}

TEST_CASE("ward: samples are those of the density") {
  for (const WardVariant variant : kVariants) {
    const Ward bsdf = glossy(0.15f, 0.5f, variant);
    for (const double theta : {10.0, 70.0}) {
      const auto fit = test::fit_smooth(bsdf, test::direction(theta, 30), {}, 5);
      CHECK(fit.chi_square.p_value > 1e-3);
      test::check_samples(bsdf, test::direction(theta, 30), {});
    }
  }
}

TEST_CASE("ward: balanced reflects at most what it gets, the others lose and gain at the edge") {
  const Vec3 above = test::direction(5, 40), slant = test::direction(84, 40);
  for (const WardVariant variant : kVariants) {
    CHECK(test::smooth_albedo(glossy(0.1f, 0.1f, variant), above) ==
          doctest::Approx(1).epsilon(0.05));
  }
  for (const double theta : {0.0, 30.0, 60.0, 80.0, 87.0}) {
    const Vec3 wo = test::direction(theta, 40);
    CHECK(test::smooth_albedo(glossy(0.4f, 0.4f, WardVariant::balanced), wo) < 1.001);
    CHECK(test::smooth_albedo(glossy(0.1f, 0.5f, WardVariant::balanced), wo) < 1.001);
  }
  CHECK(test::smooth_albedo(glossy(0.4f, 0.4f, WardVariant::ward), slant) < 0.9);
  CHECK(test::smooth_albedo(glossy(0.4f, 0.4f, WardVariant::ward_duer), slant) > 1.1);
}

TEST_CASE("ward: exchanging the roughnesses is turning the surface by a right angle") {
  const Ward a = glossy(0.1f, 0.4f, WardVariant::balanced);
  const Ward b = glossy(0.4f, 0.1f, WardVariant::balanced);
  const Vec3 wo = test::direction(50, 20), wi = test::direction(45, 170);
  const auto turned = [](Vec3 v) { return Vec3{-v.y, v.x, v.z}; };
  CHECK(a.evaluate({}, wo, wi, {}).value.g ==
        doctest::Approx(b.evaluate({}, turned(wo), turned(wi), {}).value.g));
  CHECK(a.evaluate({}, wo, wi, {}).value.g != doctest::Approx(b.evaluate({}, wo, wi, {}).value.g));
  CHECK(a.needs_tangents());
  CHECK_FALSE(glossy(0.1f, 0.1f, WardVariant::balanced).needs_tangents());
}

TEST_CASE("ward: more light than arrives is refused") {
  CHECK_THROWS_WITH_AS(Ward({.specular_reflectance = test::uniform(Rgb(0.6f)),
                             .diffuse_reflectance = test::uniform({0.1f, 0.5f, 0.1f})}),
                       "specular_reflectance and diffuse_reflectance must not add up to more than "
                       "1, but their largest values are 0.6 and 0.5",
                       InputError);
}

}  // namespace pharos

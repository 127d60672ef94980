#include "../rough_conductor.h"

#include <cmath>

#include <doctest/doctest.h>

#include "../fresnel.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

constexpr auto kGgx = FacetDistribution::ggx, kBeckmann = FacetDistribution::beckmann;

RoughConductor mirror_metal(float alpha, Masking masking, FacetDistribution distribution = kGgx) {
  return RoughConductor({.alpha = alpha,
                         .distribution = distribution,
                         .material = Metal::ideal,
                         .masking = masking,
                         .specular_reflectance = test::uniform(Rgb(1))});
}

}  // namespace

TEST_CASE("rough conductor: the textbook formula") {
  const SurfacePoint point;
  const Vec3 wo = test::direction(35, 20), wi = test::direction(55, 130);
  const Vec3 m = normalize(wo + wi);
  const ComplexIor copper = metal_ior(Metal::Cu);  // the default metal
  for (const float alpha : {0.1f, 0.5f, 1.0f}) {
    const double fresnel = conductor_fresnel(dot(wo, m), copper.eta.g, copper.k.g);
    const auto check = [&](FacetDistribution distribution, double d, double lo, double li) {
      const RoughConductor::Settings correlated{.alpha = alpha,
                                                .distribution = distribution,
                                                .specular_reflectance = test::uniform(Rgb(0.9f))};
      RoughConductor::Settings separable = correlated;
      separable.masking = Masking::separable;
      const double common = 0.9 * fresnel * d / (4 * wo.z);
      CHECK(RoughConductor(correlated).evaluate(point, wo, wi, {}).value.g ==
            doctest::Approx(common / (1 + lo + li)).epsilon(1e-4));
      CHECK(RoughConductor(separable).evaluate(point, wo, wi, {}).value.g ==
            doctest::Approx(common / ((1 + lo) * (1 + li))).epsilon(1e-4));
    };
    check(kGgx, test::ggx(m, alpha), test::smith_lambda(wo, alpha), test::smith_lambda(wi, alpha));
    check(kBeckmann, test::beckmann(m, alpha), test::beckmann_lambda(wo, alpha),
          test::beckmann_lambda(wi, alpha));
    CHECK(RoughConductor::Settings().distribution == kGgx);
  }
}

TEST_CASE("rough conductor: reflects no more than it gets, and more when masking is correlated") {
  for (const FacetDistribution distribution : {kGgx, kBeckmann}) {
    for (const float alpha : {0.1f, 0.4f, 1.0f}) {
      for (const double theta : {0.0, 45.0, 80.0}) {
        const Vec3 wo = test::direction(theta, 30);
        const auto albedo = [&](Masking masking) {
          return test::smooth_albedo(mirror_metal(alpha, masking, distribution), wo);
        };
        const double correlated = albedo(Masking::height_correlated);
        const double separable = albedo(Masking::separable);
        CAPTURE(alpha);
        CAPTURE(theta);
        CHECK(correlated <= 1.0001);
        CHECK(separable <= correlated + 1e-4);
        CHECK(separable > 0.3);
        if (alpha == 0.1f && theta == 0) CHECK(correlated > 0.98);
      }
    }
  }
}

TEST_CASE("rough conductor: samples carry the albedo") {
  // The mean weight estimates the albedo that quadrature computes. Both are bounded by one.
  const RoughConductor bsdf = mirror_metal(0.6f, Masking::height_correlated);
  const Vec3 wo = test::direction(65, 0);
  RandomStream random(3);
  constexpr int kSamples = 100'000;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    if (const auto s = bsdf.sample({}, wo, 0, random.next_2d(), {})) sum += s->weight.g;
  }
  // Weights lie in [0, 1]: four standard errors are at most 4 * 0.5 / sqrt(n).
  CHECK(std::abs(sum / kSamples - test::smooth_albedo(bsdf, wo)) < 2 / std::sqrt(kSamples));
}

TEST_CASE("rough conductor: nearly smooth metal reflects as a mirror does") {
  const Vec3 wo = test::direction(50, 70), mirrored{-wo.x, -wo.y, wo.z};
  RandomStream random(4);
  for (const FacetDistribution distribution : {kGgx, kBeckmann}) {
    const RoughConductor bsdf = mirror_metal(1e-4f, Masking::height_correlated, distribution);
    for (int i = 0; i < 100; ++i) {
      const auto s = bsdf.sample({}, wo, 0, 0.98f * random.next_2d(), {});
      REQUIRE(s);
      CHECK(length(s->direction - mirrored) < 5e-3f);
      CHECK(s->weight.r == doctest::Approx(1).epsilon(1e-3));
    }
  }
}

TEST_CASE("rough conductor: approximate albedo") {
  const RoughConductor bsdf({.alpha = 0.2f, .specular_reflectance = test::uniform(Rgb(0.8f))});
  const double exact = test::smooth_albedo(bsdf, test::direction(40, 0));
  CHECK(mean(bsdf.albedo({})) == doctest::Approx(exact).epsilon(0.05));
  CHECK(bsdf.roughness({}) == 0.2f);
}

}  // namespace pharos

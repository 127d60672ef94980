#include "../rough_plastic.h"

#include <doctest/doctest.h>

#include "../diffuse.h"
#include "../fresnel.h"
#include "../plastic.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

constexpr auto kGgx = FacetDistribution::ggx, kBeckmann = FacetDistribution::beckmann;

RoughPlastic::Settings settings(float alpha, Rgb reflectance, float ior = 1.5f,
                                FacetDistribution distribution = kGgx) {
  return {.alpha = alpha,
          .distribution = distribution,
          .ior = ior,
          .reflectance = test::uniform(reflectance),
          .specular_reflectance = test::uniform(Rgb(1)),
          .nonlinear = true};
}

}  // namespace

TEST_CASE("rough plastic: a white base reflects all light, as exactly as the table is") {
  for (const FacetDistribution distribution : {kGgx, kBeckmann}) {
    for (const float ior : {1.3f, 2.4f}) {
      for (const float alpha : {0.01f, 0.1f, 0.5f, 1.0f}) {
        // Quadrature over directions misses such a narrow lobe if it has no tails.
        if (distribution == kBeckmann && alpha == 0.01f) continue;
        const RoughPlastic bsdf(settings(alpha, Rgb(1), ior, distribution));
        for (const double theta : {0.0, 50.0, 80.0, 88.0}) {
          CAPTURE(ior);
          CAPTURE(alpha);
          CAPTURE(theta);
          const double reflected = test::smooth_albedo(bsdf, test::direction(theta, 20));
          CHECK(std::abs(reflected - 1) < 1e-3);
        }
      }
    }
  }
}

TEST_CASE("rough plastic: the share that enters is what samples do not reflect") {
  for (const FacetDistribution distribution : {kGgx, kBeckmann}) {
    for (const float alpha : {0.001f, 0.01f, 0.2f, 1.0f}) {
      const RoughCoat coat(distribution, alpha, 1.7f);
      for (const double theta : {0.0, 33.0, 71.0, 86.3, 88.0}) {
        const Vec3 wo = test::direction(theta, 20);
        constexpr int kRows = 400;
        double reflected = 0;
        for (int i = 0; i < kRows * kRows; ++i) {
          const Vec3 wi = coat.sample(wo, {(static_cast<float>(i % kRows) + 0.5f) / kRows,
                                           (static_cast<float>(i / kRows) + 0.5f) / kRows});
          if (wi.z > 0) reflected += double{coat.reflect(wo, wi).weight} / (kRows * kRows);
        }
        CAPTURE(alpha);
        CAPTURE(theta);
        CHECK(std::abs(double{coat.transmittance(wo.z)} - (1 - reflected)) < 1e-3);
      }
    }
  }
}

TEST_CASE("rough plastic: the share that enters, where the coat is almost smooth") {
  for (const FacetDistribution distribution : {kGgx, kBeckmann}) {
    const RoughCoat coat(distribution, 1e-4f, 1.5f);
    for (const float cosine : {0.05f, 0.2f, 0.7f, 1.0f}) {
      CAPTURE(cosine);
      const float fresnel = dielectric_fresnel(cosine, 1.5f).reflectance;
      CHECK(coat.transmittance(cosine) == doctest::Approx(1 - fresnel).epsilon(1e-3));
    }
    CHECK(RoughCoat(distribution, 0.3f, 1).transmittance(0.4f) == 1);
  }
}

TEST_CASE("rough plastic: equal coats let equal shares in, and others their own") {
  const auto share = [](FacetDistribution distribution, float alpha, float ior, Masking masking) {
    return RoughCoat(distribution, alpha, ior, masking).transmittance(0.3f);
  };
  constexpr Masking kCorrelated = Masking::height_correlated;
  const float first = share(kGgx, 0.35f, 1.6f, kCorrelated);
  CHECK(share(kGgx, 0.35f, 1.6f, kCorrelated) == first);
  CHECK(share(kBeckmann, 0.35f, 1.6f, kCorrelated) != first);
  CHECK(share(kGgx, 0.36f, 1.6f, kCorrelated) != first);
  CHECK(share(kGgx, 0.35f, 1.7f, kCorrelated) != first);
  CHECK(share(kGgx, 0.35f, 1.6f, Masking::separable) != first);
}

TEST_CASE("rough plastic: its base tends to that of smooth plastic") {
  const SurfacePoint point;
  const RoughPlastic rough(settings(1e-3f, {0.2f, 0.5f, 0.9f}));
  const Plastic smooth({.ior = 1.5f,
                        .reflectance = test::uniform({0.2f, 0.5f, 0.9f}),
                        .specular_reflectance = test::uniform(Rgb(1)),
                        .nonlinear = true});
  const Vec3 wo = test::direction(60, 0), wi = test::direction(40, 90);  // far from the mirror
  const Rgb a = rough.evaluate(point, wo, wi, {}).value;
  const Rgb b = smooth.evaluate(point, wo, wi, {}).value;
  for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(2e-3));
  CHECK(rough.albedo(point).b == doctest::Approx(smooth.albedo(point).b).epsilon(1e-3));
}

TEST_CASE("rough plastic: without a base only the coat is left") {
  const SurfacePoint point;
  const float alpha = 0.3f;
  const RoughPlastic bsdf(settings(alpha, Rgb(0)));
  const Vec3 wo = test::direction(35, 20), wi = test::direction(55, 130), m = normalize(wo + wi);
  // Walter et al. 2007, eq. 20, with D of eq. 33 and the height-correlated G2 of Heitz 2014.
  const auto tangent_squared = [](Vec3 v) { return (1 - double{v.z} * v.z) / (double{v.z} * v.z); };
  const auto lambda = [&](Vec3 v) {
    return 0.5 * (std::sqrt(1 + double{alpha} * alpha * tangent_squared(v)) - 1);
  };
  const double t = double{alpha} * alpha + tangent_squared(m);
  const double density = double{alpha} * alpha / (M_PI * std::pow(double{m.z}, 4) * t * t);
  const double fresnel = dielectric_fresnel(dot(wo, m), 1.5f).reflectance;
  const ScatterValue v = bsdf.evaluate(point, wo, wi, {});
  CHECK(v.value.g == doctest::Approx(fresnel * density / (4 * wo.z * (1 + lambda(wo) + lambda(wi))))
                         .epsilon(1e-4));
  CHECK(v.pdf == doctest::Approx(density / (4 * wo.z * (1 + lambda(wo)))).epsilon(1e-4));
}

TEST_CASE("rough plastic: of index one it is its base") {
  const RoughPlastic bsdf(settings(0.2f, Rgb(0.4f), 1));
  const Vec3 wo = test::direction(40, 0), wi = test::direction(70, 100);
  const ScatterValue v = bsdf.evaluate({}, wo, wi, {});
  CHECK(v.value.r == doctest::Approx(0.4 * wi.z / M_PI));
  CHECK(v.pdf == doctest::Approx(wi.z / M_PI));
}

}  // namespace pharos

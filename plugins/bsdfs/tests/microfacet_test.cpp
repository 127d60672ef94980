#include "../microfacet.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/statistics/quadrature.h>

#include "bsdf_checks.h"

namespace pharos {

TEST_CASE("beta function: the Gamma functions of double precision") {
  for (const double a : {1.0, 1.01, 2.0, 3.7, 20.0, 150.0}) {
    for (const double b : {1.0, 1.3, 2.0, 8.0, 60.0}) {
      CAPTURE(a);
      CAPTURE(b);
      const double exact = std::exp(std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b));
      if (exact < 1e-30) continue;
      const float found = beta_function(static_cast<float>(a), static_cast<float>(b));
      CHECK(found == doctest::Approx(exact).epsilon(2e-5));
    }
  }
  CHECK(beta_function(1, 1) == doctest::Approx(1).epsilon(2e-6));
}

TEST_CASE("beta function: large arguments") {
  // B(a, b) approaches Gamma(b) a^-b.
  for (const float a : {1e5f, 1e10f, 1e17f}) {
    CAPTURE(a);
    CHECK(beta_function(a, 1) == doctest::Approx(1 / double{a}).epsilon(2e-5));
    CHECK(beta_function(1.5f, a) ==
          doctest::Approx(0.5 * std::sqrt(M_PI) * std::pow(double{a}, -1.5)).epsilon(2e-4));
    CHECK(beta_function(a, a) == 0);
  }
}

TEST_CASE("GGX: shadowing below is the mean over heights") {
  const GgxDistribution facets(0.7f);
  for (const double theta : {0.0, 40.0, 75.0, 89.0}) {
    for (const double below : {180.0, 130.0, 100.0, 91.0}) {
      CAPTURE(theta);
      CAPTURE(below);
      const Vec3 wo = test::direction(theta, 10), wi = test::direction(below, 200);
      const double lo = 1 / double{facets.masking(wo)} - 1;
      const double li = 1 / double{facets.masking(-wi)} - 1;
      const auto visible = [&](double c, double) { return std::pow(c, lo) * std::pow(1 - c, li); };
      const double g2 = statistics::integrate(visible, {}, {.tolerance = 1e-7}).value;
      CHECK(facets.correlated_shadowing_below(wo, wi) ==
            doctest::Approx(g2 / double{facets.masking(wo)}).epsilon(1e-3));
      CHECK(facets.shadowing(wo, wi, Masking::separable) == facets.masking(-wi));
    }
  }
}

TEST_CASE("GGX: the density of visible normals integrates to one") {
  for (const float alpha : {0.1f, 0.5f, 1.0f}) {
    const GgxDistribution facets(alpha);
    for (const double theta : {0.0, 50.0, 85.0}) {
      const Vec3 wo = test::direction(theta, 30);
      const auto density = [&](Vec3 m) {
        const bool visible = m.z > 0 && dot(wo, m) > 0;
        return visible ? double{facets.visible_normal_pdf(wo, m)} : 0.0;
      };
      const double total = statistics::integrate_sphere(density, {.tolerance = 1e-4}, 64, 64).value;
      CHECK(total == doctest::Approx(1).epsilon(1e-3));
    }
  }
}

}  // namespace pharos

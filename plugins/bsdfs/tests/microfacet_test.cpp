#include "../microfacet.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>
#include <pharos/statistics/quadrature.h>

#include "../beckmann.h"
#include "../ggx.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

struct Alphas {
  float x, y;
};
/// Nearly smooth, medium rough and rough, and brushed along either axis.
constexpr Alphas kAlphas[]{{0.01f, 0.01f}, {0.3f, 0.3f}, {1, 1}, {0.05f, 0.6f}, {1, 0.2f}};

/// Views from straight above to almost level.
const std::vector<Vec3> kViews{test::direction(0, 0),
                               test::direction(50, 30),
                               test::direction(80, 200),
                               {0.6f, -0.79994f, 0.01f}};

}  // namespace

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

TEST_CASE_TEMPLATE("microfacets: facets cover the surface once", D, GgxDistribution,
                   BeckmannDistribution) {
  for (const Alphas alpha : kAlphas) {
    // The integral of D(m) m.z over slopes of length r = t / (1 - t) times alpha.
    const D facets(alpha.x, alpha.y);
    const auto covered = [&](double t, double phi) {
      const double r = t / (1 - t), s = r * alpha.x * std::cos(phi),
                   p = r * alpha.y * std::sin(phi);
      const double cosine = 1 / std::sqrt(1 + s * s + p * p);
      const Vec3 m{static_cast<float>(s * cosine), static_cast<float>(p * cosine),
                   static_cast<float>(cosine)};
      return double{facets.density(m)} * std::pow(cosine, 4) * alpha.x * alpha.y * r /
             ((1 - t) * (1 - t));
    };
    CAPTURE(alpha.x);
    CAPTURE(alpha.y);
    const statistics::Rectangle all{.x0 = 0, .x1 = 1, .y0 = 0, .y1 = 2 * M_PI};
    CHECK(statistics::integrate(covered, all).value == doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE_TEMPLATE("microfacets: shadowing below is the mean over heights", D, GgxDistribution,
                   BeckmannDistribution) {
  const Microfacets facets(D(0.7f, 0.7f));
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

TEST_CASE_TEMPLATE("microfacets: above, both maskings are those of Lambda", D, GgxDistribution,
                   BeckmannDistribution) {
  const Microfacets facets(D(0.8f, 0.3f));
  for (const Vec3 wo : kViews) {
    for (const Vec3 wi : kViews) {
      const double lo = 1 / double{facets.masking(wo)} - 1, li = 1 / double{facets.masking(wi)} - 1;
      CHECK(facets.shadowing(wo, wi, Masking::height_correlated) ==
            doctest::Approx((1 + lo) / (1 + lo + li)).epsilon(1e-5));
      CHECK(facets.shadowing(wo, wi, Masking::separable) ==
            doctest::Approx(1 / (1 + li)).epsilon(1e-5));
    }
  }
}

TEST_CASE_TEMPLATE(
    "microfacets: visible normals cover the view once and are drawn by their density", D,
    GgxDistribution, BeckmannDistribution) {
  std::vector<double> p_values;
  for (const Alphas alpha : kAlphas) {
    const Microfacets facets(D(alpha.x, alpha.y));
    for (const Vec3 wo : kViews) {
      const auto draw = [&](RandomStream& random) {
        return std::optional(facets.sample_visible_normal(wo, random.next_2d()));
      };
      const auto density = [&](Vec3 m) {
        const bool visible = m.z > 0 && dot(wo, m) > 0;
        return visible ? double{facets.visible_normal_pdf(wo, m)} : 0.0;
      };
      const auto fit =
          statistics::fit_direction_density(draw, density, {.seed = 20 + p_values.size()});
      CAPTURE(alpha.x);
      CAPTURE(alpha.y);
      CAPTURE(wo.z);
      CHECK(fit.is_density());
      CHECK(fit.integral == doctest::Approx(1).epsilon(1e-3));
      p_values.push_back(fit.chi_square.p_value);
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE_TEMPLATE("microfacets: level and nearly level views give sound numbers", D,
                   GgxDistribution, BeckmannDistribution) {
  for (const float alpha : {1e-4f, 0.01f, 0.3f, 1.0f}) {
    const Microfacets facets(D(alpha, alpha));
    for (const float z : {1e-2f, 1e-4f, 1e-6f, 1e-12f, 1e-30f, 1e-42f}) {
      CAPTURE(alpha);
      CAPTURE(z);
      const Vec3 wo{-0.6f, 0.8f, z};
      for (const Vec2 u : {Vec2{0, 0}, Vec2{0.3f, 0.5f}, Vec2{kOneMinusEpsilon, 0},
                           Vec2{0, kOneMinusEpsilon}, Vec2{kOneMinusEpsilon, kOneMinusEpsilon}}) {
        const Vec3 m = facets.sample_visible_normal(wo, u);
        CHECK(length(m) == doctest::Approx(1).epsilon(1e-5));
        CHECK(m.z >= 0);
        CHECK(dot(wo, m) >= -1e-6f);
        const float pdf = facets.visible_reflection_pdf(wo, m);
        CHECK(pdf >= 0);
        CHECK(std::isfinite(pdf));
      }
      CHECK(facets.masking(wo) >= 0);
      CHECK(facets.masking(wo) <= 1);
      for (const Vec3 wi : {Vec3{0, 0, 1}, Vec3{0.6f, -0.8f, z}, wo, -wo, Vec3{0, 0, -1}}) {
        for (const Masking masking : {Masking::height_correlated, Masking::separable}) {
          const float shadowing = facets.shadowing(wo, wi, masking);
          CHECK(shadowing >= 0);
          CHECK(shadowing <= 1.00001f);
        }
      }
    }
    for (const Vec3 m : {Vec3{1, 0, 0}, Vec3{0.6f, 0.8f, 1e-12f}, Vec3{0.6f, 0.8f, 1e-30f}}) {
      CHECK(facets.density(m) >= 0);
      CHECK(std::isfinite(facets.density(m)));
    }
  }
}

}  // namespace pharos

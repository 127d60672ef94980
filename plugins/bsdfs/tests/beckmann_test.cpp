#include "../beckmann.h"

#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

#include "../microfacet.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

/// The integral of (cosine + s sine) exp(-s^2) / sqrt(pi) over slopes s > x, in double precision.
double area_above(double x, double sine, double cosine) {
  return 0.5 * cosine * std::erfc(x) + 0.5 * sine * std::exp(-x * x) / std::sqrt(M_PI);
}

}  // namespace

TEST_CASE("Beckmann: the textbook formulas") {
  for (const float alpha : {0.01f, 0.2f, 1.0f}) {
    const Microfacets facets(BeckmannDistribution(alpha, alpha));
    for (const double steepness : {0.0, 0.5, 1.0, 3.0}) {
      CAPTURE(alpha);
      CAPTURE(steepness);
      const double theta = std::atan(steepness * double{alpha}) * 180 / M_PI;
      const Vec3 m = test::direction(theta, 50);
      CHECK(facets.density(m) == doctest::Approx(test::beckmann(m, alpha)).epsilon(1e-4));
    }
    for (const double theta : {0.0, 30.0, 60.0, 85.0, 89.9}) {
      CAPTURE(theta);
      const Vec3 w = test::direction(theta, 50);
      CHECK(facets.masking(w) ==
            doctest::Approx(1 / (1 + test::beckmann_lambda(w, alpha))).epsilon(1e-5));
    }
  }
}

TEST_CASE("Beckmann: stretched surfaces have the roughness of the azimuth") {
  const BeckmannDistribution facets(0.2f, 0.7f), along_x(0.2f, 0.2f), along_y(0.7f, 0.7f);
  for (const double theta : {20.0, 70.0}) {
    const Vec3 x = test::direction(theta, 0), y = test::direction(theta, 90);
    CHECK(facets.facing_area(x) == doctest::Approx(along_x.facing_area(x)).epsilon(1e-5));
    CHECK(facets.facing_area(y) == doctest::Approx(along_y.facing_area(y)).epsilon(1e-5));
  }
  // D is the density of two independent Gaussian slopes.
  const Vec3 m = test::direction(30, 40);
  const double x = m.x / m.z / 0.2, y = m.y / m.z / 0.7;
  CHECK(facets.density(m) ==
        doctest::Approx(std::exp(-x * x - y * y) / (M_PI * 0.2 * 0.7 * std::pow(double{m.z}, 4)))
            .epsilon(1e-4));
}

TEST_CASE("Beckmann: drawn slopes invert the distribution function to single precision") {
  const BeckmannDistribution facets(1, 1);
  for (const double cotangent : {1e-30, 1e-6, 1e-3, 0.1, 0.3, 1.0, 2.0, 5.0, 100.0, 1e6}) {
    const double sine = 1 / std::hypot(1, cotangent), cosine = cotangent * sine;
    const Vec3 wo{static_cast<float>(sine), 0, static_cast<float>(cosine)};
    const double visible = area_above(-cotangent, sine, cosine);
    for (int i = 0; i < 4000; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / 4000;
      // Covers values close to both ends, too.
      for (const float share : {u, 1e-3f * u, 1 - 1e-3f * u}) {
        const Vec3 m = facets.sample_visible_normal(wo, {1 - share, share});
        const double x = double{m.x} / m.z, y = double{m.y} / m.z;
        CAPTURE(cotangent);
        CAPTURE(share);
        CHECK(std::abs(area_above(x, sine, cosine) / visible - share) < 1e-6);
        CHECK(std::abs(0.5 * std::erfc(y) - (1 - share)) < 1e-6);
      }
    }
  }
}

TEST_CASE("Beckmann: from straight above there is no azimuth") {
  const BeckmannDistribution facets(0.5f, 0.1f);
  const Vec3 m = facets.sample_visible_normal({0, 0, 1}, {0.9f, 0.2f});
  CHECK(0.5 * std::erfc(double{m.x} / m.z / 0.5) == doctest::Approx(0.2).epsilon(1e-5));
  CHECK(0.5 * std::erfc(double{m.y} / m.z / 0.1) == doctest::Approx(0.9).epsilon(1e-5));
}

}  // namespace pharos

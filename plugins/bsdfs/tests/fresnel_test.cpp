#include "../fresnel.h"

#include <cmath>
#include <complex>

#include <doctest/doctest.h>

namespace pharos {
namespace {

/// Fresnel's equations in complex arithmetic.
double complex_fresnel(double cosine, std::complex<double> index) {
  const std::complex<double> sine = std::sqrt(1 - cosine * cosine) / index;
  const std::complex<double> inner = std::sqrt(1.0 - sine * sine);
  const auto s = (cosine - index * inner) / (cosine + index * inner);
  const auto p = (index * cosine - inner) / (index * cosine + inner);
  return 0.5 * (std::norm(s) + std::norm(p));
}

}  // namespace

TEST_CASE("dielectric Fresnel: textbook values") {
  CHECK(dielectric_fresnel(1, 1.5f).reflectance == doctest::Approx(0.04));
  CHECK(dielectric_fresnel(1, 1 / 1.5f).reflectance == doctest::Approx(0.04));
  CHECK(dielectric_fresnel(0, 1.5f).reflectance == doctest::Approx(1));
  // At Brewster's angle, tan = eta, only s-polarized light is reflected.
  const float brewster = std::cos(std::atan(1.5f));
  const double s = (1 - 2.25) / (1 + 2.25);
  CHECK(dielectric_fresnel(brewster, 1.5f).reflectance == doctest::Approx(0.5 * s * s));
  CHECK(dielectric_fresnel(0.4f, 1).reflectance == 0);
}

TEST_CASE("dielectric Fresnel: Snell's law and total internal reflection") {
  const float cosine = std::cos(radians(30));
  const float refracted = dielectric_fresnel(cosine, 1.5f).cos_transmitted;
  CHECK(std::sqrt(1 - refracted * refracted) == doctest::Approx(0.5 / 1.5));
  const double critical = std::asin(1 / 1.5);
  const float beyond = static_cast<float>(std::cos(critical + 1e-3));
  const float before = static_cast<float>(std::cos(critical - 1e-3));
  CHECK(dielectric_fresnel(beyond, 1 / 1.5f).reflectance == 1);
  CHECK(dielectric_fresnel(beyond, 1 / 1.5f).cos_transmitted == 0);
  CHECK(dielectric_fresnel(before, 1 / 1.5f).reflectance < 1);
}

TEST_CASE("dielectric Fresnel: both ways along one ray are the same") {
  for (const float cosine : {0.05f, 0.3f, 0.8f}) {
    const DielectricFresnel in = dielectric_fresnel(cosine, 1.33f);
    const DielectricFresnel out = dielectric_fresnel(in.cos_transmitted, 1 / 1.33f);
    CHECK(out.reflectance == doctest::Approx(in.reflectance).epsilon(1e-4));
    CHECK(out.cos_transmitted == doctest::Approx(cosine).epsilon(1e-4));
  }
}

TEST_CASE("conductor Fresnel: complex arithmetic") {
  const std::complex<double> metals[] = {{0.2, 3.9}, {1.1, 2.14}, {1.66, 9.2}, {3, 0.1}, {0.05, 2}};
  for (const auto metal : metals) {
    for (const double cosine : {1.0, 0.9, 0.5, 0.1, 0.01, 1e-4}) {
      CAPTURE(cosine);
      CHECK(conductor_fresnel(static_cast<float>(cosine), static_cast<float>(metal.real()),
                              static_cast<float>(metal.imag())) ==
            doctest::Approx(complex_fresnel(cosine, {metal.real(), -metal.imag()})).epsilon(1e-4));
    }
  }
}

TEST_CASE("conductor Fresnel: the ends of the ranges that settings may have") {
  for (const double eta : {1e-4, 1.0, 1e4}) {
    for (const double k : {0.0, 1e-4, 1.0, 1e4}) {
      for (const double cosine : {1.0, 0.5, 1e-2}) {
        CAPTURE(eta);
        CAPTURE(k);
        CAPTURE(cosine);
        const float value = conductor_fresnel(static_cast<float>(cosine), static_cast<float>(eta),
                                              static_cast<float>(k));
        CHECK(value == doctest::Approx(complex_fresnel(cosine, {eta, -k})).epsilon(2e-3));
      }
      CHECK(conductor_fresnel(0, static_cast<float>(eta), static_cast<float>(k)) == 1);
    }
  }
}

TEST_CASE("conductor Fresnel: limits") {
  CHECK(conductor_fresnel(1, 0.2f, 3.9f) == doctest::Approx((0.64 + 15.21) / (1.44 + 15.21)));
  CHECK(conductor_fresnel(0, 0.2f, 3.9f) == doctest::Approx(1));
  CHECK(conductor_fresnel(0.7f, 1.5f, 0) ==
        doctest::Approx(dielectric_fresnel(0.7f, 1.5f).reflectance).epsilon(1e-4));
}

}  // namespace pharos

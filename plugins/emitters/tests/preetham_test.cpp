#include "../preetham.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace pharos {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// The luminance [cd/m^2] of a radiance of 1 W/(m^2 sr nm).
constexpr double kLumens = 683.002 * 106.856895;

double luminance_of(Rgb c) {
  return 0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b;
}

/// The CIE 1931 chromaticity of linear Rec.709.
std::array<double, 2> chromaticity(Rgb c) {
  const double x = 0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b;
  const double z = 0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b;
  const double sum = x + luminance_of(c) + z;
  return {x / sum, luminance_of(c) / sum};
}

}  // namespace

TEST_CASE("preetham: luminance at the zenith") {
  // Values of the paper's formula, computed by hand.
  CHECK(PreethamSky(2, 30 * kDegree).zenith_luminance() == doctest::Approx(5.886743));
  CHECK(PreethamSky(3, 45 * kDegree).zenith_luminance() == doctest::Approx(7.320358));
  CHECK(PreethamSky(6, 70 * kDegree).zenith_luminance() == doctest::Approx(6.579692));
  for (const double turbidity : {2.0, 3.0, 6.0}) {
    const PreethamSky sky(turbidity, 50 * kDegree);
    CHECK(kLumens * luminance_of(sky.radiance(0, 50 * kDegree)) ==
          doctest::Approx(1000 * sky.zenith_luminance()).epsilon(1e-5));
  }
}

TEST_CASE("preetham: chromaticity at the zenith") {
  // x = (T^2, T, 1) M (s^3, s^2, s, 1); for s = 0 only the last columns of the matrices count.
  const auto [x, y] = chromaticity(PreethamSky(4, 0).radiance(0, 0));
  CHECK(x == doctest::Approx(0.00394 * 4 + 0.25885).epsilon(1e-4));
  CHECK(y == doctest::Approx(0.00515 * 4 + 0.26688).epsilon(1e-4));
  // For s = 1 the sums of the matrices' rows count.
  const auto [x1, y1] = chromaticity(PreethamSky(2, 1).radiance(0, 1));
  CHECK(x1 == doctest::Approx(4 * -0.00001 + 2 * 0.00667 + 0.22434).epsilon(1e-4));
  CHECK(y1 == doctest::Approx(4 * -0.00019 + 2 * 0.01118 + 0.21946).epsilon(1e-4));
}

TEST_CASE("preetham: the sky is blue opposite the sun, and brightest around it") {
  const PreethamSky sky(2.5, 40 * kDegree);
  const Rgb opposite = sky.radiance(50 * kDegree, 90 * kDegree);
  CHECK(opposite.b > 1.5f * opposite.r);
  CHECK(luminance_of(sky.radiance(40 * kDegree, 0)) >
        3 * luminance_of(sky.radiance(40 * kDegree, 80 * kDegree)));
}

TEST_CASE("preetham: finite and not negative at all turbidities, suns and directions") {
  int wrong = 0, black = 0;
  for (double turbidity = 1.7; turbidity <= 10; turbidity += 0.1) {
    for (int sun = 0; sun <= 90; sun += 5) {
      const PreethamSky sky(turbidity, sun * kDegree);
      for (const double zenith : {0.0, 30.0, 60.0, 85.0, 89.9, 89.999999}) {
        for (int gamma = 0; gamma <= 180; gamma += 20) {
          const Rgb c = sky.radiance(zenith * kDegree, gamma * kDegree);
          wrong += is_finite(c) && std::min({c.r, c.g, c.b}) >= 0 ? 0 : 1;
          black += is_black(c) ? 1 : 0;
        }
      }
      wrong += is_finite(preetham_sun_radiance(turbidity, sun * kDegree)) ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
  CHECK(black == 0);
}

TEST_CASE("preetham: the sun's radiance agrees with integration in steps of a nanometre") {
  // Integrates the paper's formulas with its ozone table in steps of 5 nm, from 360 to 830 nm.
  const auto check = [](double turbidity, double zenith, Rgb expected) {
    const Rgb found = preetham_sun_radiance(turbidity, zenith * kDegree);
    CHECK(found.r == doctest::Approx(expected.r).epsilon(0.01));
    CHECK(found.g == doctest::Approx(expected.g).epsilon(0.01));
    CHECK(found.b == doctest::Approx(expected.b).epsilon(0.01));
  };
  check(2, 0, {23018.7f, 20022.1f, 17872.7f});
  check(3, 45, {19064.7f, 15745.9f, 12695.7f});
  check(6, 70, {6322.33f, 3913.23f, 1841.21f});
  const Rgb setting = preetham_sun_radiance(3, 88 * kDegree);
  CHECK(setting.r == doctest::Approx(167.53).epsilon(0.03));
  CHECK(setting.b == 0);  // out of gamut
}

TEST_CASE("preetham: a high sun makes about 100 klx at normal incidence") {
  const double solid_angle = 2 * std::numbers::pi * (1 - std::cos(0.2679 * kDegree));
  const double lux = kLumens * luminance_of(preetham_sun_radiance(2, 0)) * solid_angle;
  CHECK(lux > 95'000);
  CHECK(lux < 110'000);
}

TEST_CASE("xyz: the matching functions have the integrals of the CIE's") {
  Xyz sum;
  for (int wavelength = 360; wavelength <= 830; ++wavelength) sum += matching_functions(wavelength);
  CHECK(sum.x == doctest::Approx(106.865).epsilon(2e-3));
  CHECK(sum.y == doctest::Approx(106.857).epsilon(2e-3));
  CHECK(sum.z == doctest::Approx(106.892).epsilon(2e-3));
}

}  // namespace pharos

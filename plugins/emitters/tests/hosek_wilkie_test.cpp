#include "../hosek_wilkie.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "../hosek_wilkie_data.h"

namespace pharos {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// The mean over the upper hemisphere.
Rgb mean_radiance(const HosekWilkieSky& sky, double sun_zenith) {
  constexpr int kRows = 400, kColumns = 800;
  double sums[3] = {};
  for (int row = 0; row < kRows; ++row) {
    const double zenith = std::acos((row + 0.5) / kRows);
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2 * std::numbers::pi * (column + 0.5) / kColumns;
      const double cosine = std::cos(zenith) * std::cos(sun_zenith) +
                            std::sin(zenith) * std::sin(sun_zenith) * std::cos(azimuth);
      const Rgb c = sky.radiance(zenith, std::acos(std::clamp(cosine, -1.0, 1.0)));
      for (int i = 0; i < 3; ++i) sums[i] += c[i];
    }
  }
  constexpr double kCount = double{kRows} * kColumns;
  return {static_cast<float>(sums[0] / kCount), static_cast<float>(sums[1] / kCount),
          static_cast<float>(sums[2] / kCount)};
}

}  // namespace

TEST_CASE("hosek_wilkie: means over the sky agree with integration by another program") {
  // The formula and the published tables, integrated by NumPy in 1600 x 3200 directions.
  const auto check = [](double turbidity, double zenith, double ground, Rgb expected) {
    const HosekWilkieSky sky(turbidity, Rgb(static_cast<float>(ground)), zenith * kDegree);
    const Rgb found = mean_radiance(sky, zenith * kDegree);
    for (int i = 0; i < 3; ++i) CHECK(found[i] == doctest::Approx(expected[i]).epsilon(0.002));
  };
  check(3, 65.4, 0.15, {0.066229f, 0.091585f, 0.118343f});
  check(2, 30, 0.15, {0.052796f, 0.087458f, 0.150848f});
  check(6.5, 70, 0.5, {0.129367f, 0.131566f, 0.127579f});
  check(10, 88, 0, {0.019885f, 0.016505f, 0.013157f});
}

TEST_CASE("hosek_wilkie: the ground and the air change the sky linearly between table entries") {
  const double zenith = 50 * kDegree, gamma = 70 * kDegree;
  const auto at = [&](double turbidity, float ground) {
    return HosekWilkieSky(turbidity, Rgb(ground), 40 * kDegree).radiance(zenith, gamma);
  };
  // Parameters are interpolated, not radiances, so values between the entries are near the mean.
  for (int i = 0; i < 3; ++i) {
    CHECK(at(3.5, 0)[i] == doctest::Approx(0.5f * (at(3, 0)[i] + at(4, 0)[i])).epsilon(0.05));
    CHECK(at(3, 0.5f)[i] == doctest::Approx(0.5f * (at(3, 0)[i] + at(3, 1)[i])).epsilon(0.05));
    CHECK(at(3, 1)[i] > at(3, 0)[i]);
  }
  CHECK(at(10, 0.3f).b > 0);
  // Each channel has its own ground.
  const Rgb green = HosekWilkieSky(3, {0, 1, 0}, 40 * kDegree).radiance(zenith, gamma);
  CHECK(green == Rgb(at(3, 0).r, at(3, 1).g, at(3, 0).b));
}

TEST_CASE("hosek_wilkie: the first table entry is the sky with the sun at the horizon") {
  // Only the first control point counts there.
  const float* const p = hosek_wilkie::kShape[1][0][2][0];
  const double gamma = 30 * kDegree, up = std::cos(60 * kDegree);
  const double mie = (1 + std::pow(std::cos(gamma), 2)) /
                     std::pow(1 + p[8] * p[8] - 2 * p[8] * std::cos(gamma), 1.5);
  const double expected = hosek_wilkie::kMeanRadiance[1][0][2][0] / 106.85698 *
                          (1 + p[0] * std::exp(p[1] / (up + 0.01))) *
                          (p[2] + p[3] * std::exp(p[4] * gamma) +
                           p[5] * std::pow(std::cos(gamma), 2) + p[6] * mie + p[7] * std::sqrt(up));
  CHECK(HosekWilkieSky(3, Rgb(0), 90 * kDegree).radiance(60 * kDegree, gamma).g ==
        doctest::Approx(expected));
}

TEST_CASE("hosek_wilkie: finite and not negative at all turbidities, suns and directions") {
  int wrong = 0;
  for (double turbidity = 1; turbidity <= 10; turbidity += 0.25) {
    for (int sun = 0; sun <= 90; sun += 5) {
      for (const float ground : {0.0f, 0.4f, 1.0f}) {
        const HosekWilkieSky sky(turbidity, Rgb(ground), sun * kDegree);
        for (const double zenith : {0.0, 30.0, 60.0, 85.0, 89.999999}) {
          for (int gamma = 0; gamma <= 180; gamma += 20) {
            const Rgb c = sky.radiance(zenith * kDegree, gamma * kDegree);
            wrong += is_finite(c) && std::min({c.r, c.g, c.b}) >= 0 ? 0 : 1;
          }
        }
      }
    }
  }
  CHECK(wrong == 0);
}

}  // namespace pharos

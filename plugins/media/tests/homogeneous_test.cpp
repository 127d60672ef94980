#include "../homogeneous.h"

#include <cmath>

#include <doctest/doctest.h>

#include "../isotropic.h"

namespace pharos {
namespace {

constexpr Rgb kEven(1.0f / 3);

Ray ray_to(float t) {
  return {{0, 0, 0}, {0, 0, 1}, t};
}

HomogeneousMedium medium(Rgb scattering, Rgb absorption) {
  return HomogeneousMedium({.scattering = scattering,
                            .absorption = absorption,
                            .scale = 2,
                            .phase = std::make_shared<const IsotropicPhase>()});
}

TEST_CASE("light is lost by scattering and absorption, channel by channel") {
  const HomogeneousMedium fog = medium({0.1f, 0.2f, 0}, {0, 0.3f, 0});
  const Rgb left = fog.leg(ray_to(3), kEven, 3).transmittance;
  CHECK(left.r == doctest::Approx(std::exp(-0.6)));
  CHECK(left.g == doctest::Approx(std::exp(-3.0)));
  CHECK(left.b == 1);
  CHECK(fog.scattering({}) == Rgb(0.2f, 0.4f, 0));
  const Rgb far = fog.leg(ray_to(kInfinity), kEven, kInfinity).transmittance;
  CHECK(far == Rgb(0, 0, 1));
}

TEST_CASE("distances follow the channel that was chosen, densities are the channels' mean") {
  const HomogeneousMedium fog = medium({0.5f, 1, 0}, {});
  const DistanceSample red = fog.sample(ray_to(10), kEven, 0.1f, 0.5f);
  CHECK(red.scattered);
  CHECK(red.t == doctest::Approx(std::log(2.0)));
  CHECK(fog.sample(ray_to(10), kEven, 0.5f, 0.5f).t == doctest::Approx(std::log(2.0) / 2));
  CHECK_FALSE(fog.sample(ray_to(10), kEven, 0.9f, 0.5f).scattered);
  CHECK_FALSE(fog.sample(ray_to(0.5f), kEven, 0.1f, 0.5f).scattered);
  CHECK(fog.leg(ray_to(10), kEven, 1).scatter_pdf ==
        doctest::Approx((std::exp(-1.0) + 2 * std::exp(-2.0)) / 3));
  CHECK(fog.leg(ray_to(10), kEven, 1).pass_probability ==
        doctest::Approx((std::exp(-1.0) + std::exp(-2.0) + 1) / 3));
}

TEST_CASE("channels are chosen by their shares") {
  const HomogeneousMedium fog = medium({0.5f, 1, 0}, {});
  const Rgb green(0, 1, 0);
  CHECK(fog.sample(ray_to(10), green, 0.01f, 0.5f).t == doctest::Approx(std::log(2.0) / 2));
  CHECK(fog.leg(ray_to(10), green, 1).scatter_pdf == doctest::Approx(2 * std::exp(-2.0)));
  CHECK(channel_shares({2, 1, 1}) == Rgb(0.5f, 0.25f, 0.25f));
  CHECK(channel_shares({}).g == doctest::Approx(1.0 / 3));
}

TEST_CASE("what only absorbs lets every ray pass") {
  const HomogeneousMedium glass = medium({}, {1, 2, 3});
  CHECK_FALSE(glass.sample(ray_to(kInfinity), kEven, 0.5f, 0.999f).scattered);
  CHECK(glass.leg(ray_to(5), kEven, 1).scatter_pdf == 0);
  CHECK(glass.leg(ray_to(5), kEven, 5).pass_probability == 1);
  CHECK(glass.leg(ray_to(5), kEven, 1).transmittance.g == doctest::Approx(std::exp(-4.0)));
}

}  // namespace
}  // namespace pharos

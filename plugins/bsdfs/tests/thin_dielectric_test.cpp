#include "../thin_dielectric.h"

#include <cmath>

#include <doctest/doctest.h>

#include "../fresnel.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

ThinDielectric pane(float ior, Rgb reflectance = Rgb(1), Rgb transmittance = Rgb(1)) {
  return ThinDielectric({.ior = ior,
                         .specular_reflectance = test::uniform(reflectance),
                         .specular_transmittance = test::uniform(transmittance)});
}

}  // namespace

TEST_CASE("thin dielectric: light that goes to and fro in the pane, summed") {
  for (const double theta : {0.0, 45.0, 80.0, 89.5, 120.0, 180.0}) {
    CAPTURE(theta);
    const Vec3 wo = test::direction(theta, 70);
    const double face = dielectric_fresnel(std::min(1.0f, std::abs(wo.z)), 1.5f).reflectance;
    double reflected = face, transmitted = 0, inside = 1 - face;
    for (int i = 0; i < 5000; ++i) {
      (i % 2 == 0 ? transmitted : reflected) += inside * (1 - face);
      inside *= face;
    }
    for (const Transport transport : {Transport::radiance, Transport::importance}) {
      const DiscreteOutcomes all = pane(1.5f).discrete({}, wo, {.transport = transport});
      REQUIRE(all.count == 2);
      CHECK(all.outcomes[0].event == Event::discrete_reflect);
      CHECK(all.outcomes[0].direction == Vec3{-wo.x, -wo.y, wo.z});
      CHECK(all.outcomes[0].value.r == doctest::Approx(reflected).epsilon(1e-4));
      CHECK(all.outcomes[1].event == Event::pass_through);
      CHECK(all.outcomes[1].direction == -wo);
      CHECK(all.outcomes[1].value.r == doctest::Approx(transmitted).epsilon(1e-4));
      CHECK(all.outcomes[0].value.r + all.outcomes[1].value.r == doctest::Approx(1));
    }
  }
}

TEST_CASE("thin dielectric: window glass at normal incidence") {
  // With F = 0.04 the pane reflects 2 F / (1 + F), which is 7.7 %.
  CHECK(pane(1.5f).discrete({}, {0, 0, 1}, {}).begin()->value.g == doctest::Approx(0.08 / 1.04));
  CHECK(pane(1.5f).relative_ior() == 1);
  CHECK(pane(1.5f).roughness({}) == 0);
}

TEST_CASE("thin dielectric: total reflection at a gap, and no pane at all") {
  const Vec3 wo = test::direction(60, 0);  // beyond the critical angle of 41.8 degrees
  const DiscreteOutcomes gap = pane(1 / 1.5f).discrete({}, wo, {});
  REQUIRE(gap.count == 1);
  CHECK(gap.begin()->event == Event::discrete_reflect);
  CHECK(gap.begin()->value == Rgb(1));
  const DiscreteOutcomes air = pane(1).discrete({}, wo, {});
  REQUIRE(air.count == 1);
  CHECK(air.begin()->event == Event::pass_through);
  CHECK(air.begin()->value == Rgb(1));
  CHECK(pane(1.5f).discrete({}, {0, 1, 0}, {}).count == 0);
}

TEST_CASE("thin dielectric: albedo is the mean over directions of what is reflected") {
  for (const float ior : {1.1f, 1.5f, 2.4f, 0.75f}) {
    CAPTURE(ior);
    const ThinDielectric mirror = pane(ior, Rgb(1), Rgb(0));
    double sum = 0;
    constexpr int kPoints = 20'000;
    for (int i = 0; i < kPoints; ++i) {
      // The square of the cosine is uniform.
      const double squared = (i + 0.5) / kPoints;
      const Vec3 wo{static_cast<float>(std::sqrt(1 - squared)), 0,
                    static_cast<float>(std::sqrt(squared))};
      const DiscreteOutcome o = mirror.discrete({}, wo, {}).outcomes[0];
      sum += double{o.event == Event::discrete_reflect ? o.value.g : 0} / kPoints;
    }
    CHECK(mirror.albedo({}).g == doctest::Approx(sum).epsilon(5e-4));
  }
}

TEST_CASE("thin dielectric: conditioning on events, and factors") {
  const ThinDielectric tinted = pane(1.5f, {0.9f, 0.5f, 0}, {0.1f, 1, 0.3f});
  for (const double theta : {10.0, 85.0, 100.0}) {
    const Vec3 wo = test::direction(theta, 5);
    for (const EventMask mask : {EventMask::all, EventMask::reflect, EventMask::transmit}) {
      test::check_samples(tinted, wo, {.events = mask});
      double sum = 0;
      for (const auto& o : tinted.discrete({}, wo, {.events = mask})) sum += double{o.probability};
      CHECK(sum == doctest::Approx(1));
    }
    const auto through = tinted.sample({}, wo, 0, {}, {.events = EventMask::transmit});
    REQUIRE(through);
    CHECK(through->pdf == 1);
    CHECK(through->weight.r == doctest::Approx(0.1 * through->weight.g));
    CHECK_FALSE(tinted.sample({}, wo, 0.5f, {}, {.events = EventMask::smooth}));
  }
  CHECK(max_component(tinted.albedo({})) <= 1);
}

}  // namespace pharos

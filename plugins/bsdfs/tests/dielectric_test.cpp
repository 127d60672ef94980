#include "../dielectric.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/hypothesis.h>

#include "../fresnel.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

constexpr EventMask kReflect = EventMask::reflect;
constexpr EventMask kTransmit = EventMask::transmit;

Dielectric clear(float ior) {
  return Dielectric({.ior = ior,
                     .specular_reflectance = test::uniform(Rgb(1)),
                     .specular_transmittance = test::uniform(Rgb(1))});
}

const DiscreteOutcome& outcome(const DiscreteOutcomes& all, Event event) {
  for (const DiscreteOutcome& o : all) {
    if (o.event == event) return o;
  }
  FAIL("the event is not possible");
  return *all.begin();
}

}  // namespace

TEST_CASE("dielectric: directions") {
  const Dielectric glass = clear(1.5f);
  const Vec3 wo = test::direction(30, 40);
  const DiscreteOutcomes all = glass.discrete({}, wo, {});
  REQUIRE(all.count == 2);
  CHECK(outcome(all, Event::discrete_reflect).direction == Vec3{-wo.x, -wo.y, wo.z});
  const Vec3 wi = outcome(all, Event::discrete_transmit).direction;
  CHECK(wi.z < 0);
  CHECK(wi.x == doctest::Approx(-wo.x / 1.5));
  CHECK(wi.y == doctest::Approx(-wo.y / 1.5));
  CHECK(length(wi) == doctest::Approx(1));
}

TEST_CASE("dielectric: energy, and the factor of compressed solid angle") {
  const Dielectric glass = clear(1.5f);
  for (const double theta : {0.0, 30.0, 70.0, 89.0, 100.0, 150.0, 180.0}) {
    CAPTURE(theta);
    const Vec3 wo = test::direction(theta, -60);
    const double eta = wo.z > 0 ? 1.5 : 1 / 1.5;
    double radiance = 0, importance = 0, probability = 0;
    for (const auto& o : glass.discrete({}, wo, {.transport = Transport::radiance})) {
      radiance += o.value.g * (o.event == Event::discrete_transmit ? eta * eta : 1);
      probability += o.probability;
    }
    for (const auto& o : glass.discrete({}, wo, {.transport = Transport::importance})) {
      importance += o.value.g;
    }
    CHECK(radiance == doctest::Approx(1));
    CHECK(importance == doctest::Approx(1));
    CHECK(probability == doctest::Approx(1));
  }
}

TEST_CASE("dielectric: through a slab and out again") {
  const Dielectric glass = clear(1.7f);
  const Vec3 wo = test::direction(50, 10);
  for (const Transport transport : {Transport::radiance, Transport::importance}) {
    const auto in = glass.sample({}, wo, 0, {}, {transport, kTransmit});
    REQUIRE(in);
    // The direction in the frame of the second, parallel face, whose normal points outside on the
    // other side.
    const Vec3 back{-in->direction.x, in->direction.y, in->direction.z};
    const auto out = glass.sample({}, back, 0, {}, {transport, kTransmit});
    REQUIRE(out);
    CHECK(out->direction.z == doctest::Approx(wo.z).epsilon(1e-5));
    const float fresnel = dielectric_fresnel(wo.z, 1.7f).reflectance;
    const float expected = (1 - fresnel) * (1 - fresnel);
    CHECK(in->weight.g * out->weight.g == doctest::Approx(expected).epsilon(1e-4));
    // Without conditioning, both faces together change nothing.
    const auto first = glass.sample({}, wo, 0.999f, {}, {transport, EventMask::all});
    const auto second = glass.sample({}, back, 0.999f, {}, {transport, EventMask::all});
    CHECK(first->weight.g * second->weight.g == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("dielectric: conditioning on events") {
  const Dielectric glass = clear(1.5f);
  for (const double theta : {10.0, 85.0, 120.0, 175.0}) {
    const Vec3 wo = test::direction(theta, 0);
    for (const EventMask mask : {EventMask::all, kReflect, kTransmit, EventMask::discrete}) {
      test::check_samples(glass, wo, {.events = mask});
      const DiscreteOutcomes all = glass.discrete({}, wo, {.events = mask});
      float sum = 0;
      for (const DiscreteOutcome& o : all) sum += o.probability;
      CHECK((all.count == 0 || sum == doctest::Approx(1)));
    }
    CHECK(glass.discrete({}, wo, {.events = EventMask::smooth}).count == 0);
    CHECK_FALSE(glass.sample({}, wo, 0.5f, {}, {.events = EventMask::smooth}));
    const auto reflected = glass.sample({}, wo, 0.999f, {}, {.events = kReflect});
    REQUIRE(reflected);
    CHECK(reflected->pdf == 1);
    const float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    CHECK(reflected->weight.r ==
          doctest::Approx(dielectric_fresnel(std::abs(wo.z), eta).reflectance));
  }
}

TEST_CASE("dielectric: total internal reflection") {
  const Dielectric glass = clear(1.5f);
  const Vec3 wo = test::direction(120, 0);  // inside, 60 degrees from the normal
  CHECK(glass.discrete({}, wo, {}).count == 1);
  const auto s = glass.sample({}, wo, 0.999f, {}, {});
  REQUIRE(s);
  CHECK(s->event == Event::discrete_reflect);
  CHECK(s->pdf == 1);
  CHECK(s->weight == Rgb(1));
  CHECK_FALSE(glass.sample({}, wo, 0.5f, {}, {.events = kTransmit}));
}

TEST_CASE("dielectric: events come with their probabilities") {
  const Dielectric glass = clear(1.5f);
  RandomStream random(11);
  constexpr int kSamples = 100'000;
  std::vector<double> p_values;
  for (const double theta : {0.0, 60.0, 80.0, 145.0}) {
    const Vec3 wo = test::direction(theta, 0);
    const double p = outcome(glass.discrete({}, wo, {}), Event::discrete_reflect).probability;
    int reflected = 0;
    for (int i = 0; i < kSamples; ++i) {
      reflected += glass.sample({}, wo, random.next_1d(), {}, {})->event == Event::discrete_reflect;
    }
    const statistics::Estimate share{.mean = reflected / double{kSamples},
                                     .squared_error = p * (1 - p) / kSamples};
    p_values.push_back(statistics::one_sample_test(share, p).p_value);
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("dielectric: factors tint either way and leave the choice to Fresnel") {
  const Rgb mirrored{0.9f, 0.5f, 0}, refracted{0.1f, 1, 0.3f};
  const Dielectric tinted({.ior = 1.5f,
                           .specular_reflectance = test::uniform(mirrored),
                           .specular_transmittance = test::uniform(refracted)});
  const Vec3 wo = test::direction(75, 20);
  const DiscreteOutcomes plain = clear(1.5f).discrete({}, wo, {}),
                         all = tinted.discrete({}, wo, {});
  REQUIRE(all.count == 2);
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    CHECK(all.outcomes[k].probability == plain.outcomes[k].probability);
    CHECK(all.outcomes[k].value == plain.outcomes[k].value * (i == 0 ? mirrored : refracted));
  }
  test::check_samples(tinted, wo, {});
  // The mean over the hemisphere for glass of index 1.5 is 0.0918.
  CHECK(tinted.albedo({}).r == doctest::Approx(0.0918 * 0.9 + 0.9082 * 0.1).epsilon(5e-3));
}

TEST_CASE("dielectric: index-matched and level directions") {
  const Dielectric air = clear(1);
  const Vec3 wo = test::direction(70, 0);
  const auto s = air.sample({}, wo, 0, {}, {});
  REQUIRE(s);
  CHECK(s->event == Event::discrete_transmit);
  CHECK(s->weight.g == doctest::Approx(1));
  CHECK(length(s->direction + wo) < 1e-6f);
  const Dielectric glass = clear(1.5f);
  CHECK(glass.discrete({}, {1, 0, 0}, {}).count == 0);
  CHECK_FALSE(glass.sample({}, {1, 0, 0}, 0.5f, {}, {}));
  CHECK(glass.relative_ior() == doctest::Approx(1 / 1.5));
}

}  // namespace pharos

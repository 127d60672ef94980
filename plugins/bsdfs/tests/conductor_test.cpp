#include "../conductor.h"

#include <doctest/doctest.h>

#include "../fresnel.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

Conductor metal(Metal material, Rgb factor = Rgb(1)) {
  return Conductor({.material = material, .specular_reflectance = test::uniform(factor)});
}

}  // namespace

TEST_CASE("conductor: the mirror direction with Fresnel's share") {
  const Rgb factor{0.9f, 0.8f, 0.7f};
  const Conductor gold = metal(Metal::Au, factor);
  const ComplexIor ior = metal_ior(Metal::Au);
  for (const double theta : {0.0, 30.0, 70.0, 89.9}) {
    const Vec3 wo = test::direction(theta, 50);
    const DiscreteOutcomes all = gold.discrete({}, wo, {});
    REQUIRE(all.count == 1);
    const DiscreteOutcome& mirrored = *all.begin();
    CHECK(mirrored.event == Event::discrete_reflect);
    CHECK(mirrored.direction == Vec3{-wo.x, -wo.y, wo.z});
    CHECK(mirrored.probability == 1);
    CHECK(mirrored.value == conductor_fresnel(wo.z, ior.eta, ior.k) * factor);
    test::check_samples(gold, wo, {});
    test::check_samples(gold, wo, {.transport = Transport::importance});
  }
}

TEST_CASE("conductor: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2) at normal incidence") {
  const Conductor bsdf(
      {.eta = Rgb(1.5f), .k = Rgb(2), .specular_reflectance = test::uniform(Rgb(1))});
  CHECK(bsdf.discrete({}, {0, 0, 1}, {}).begin()->value.g ==
        doctest::Approx((0.25 + 4) / (6.25 + 4)));
}

TEST_CASE("conductor: the ideal metal loses nothing") {
  const Conductor mirror = metal(Metal::ideal);
  for (const float z : {1.0f, 0.3f, 1e-4f, 1e-30f}) {
    const auto s = mirror.sample({}, {std::sqrt(1 - z * z), 0, z}, 0.5f, {}, {});
    REQUIRE(s);
    CHECK(s->weight == Rgb(1));
  }
  CHECK(mirror.albedo({}) == Rgb(1));
}

TEST_CASE("conductor: the back side and excluded events are black") {
  const Conductor bsdf = metal(Metal::Cu);
  const Vec3 above = test::direction(30, 0);
  for (const Vec3 wo : {test::direction(150, 0), Vec3{1, 0, 0}}) {
    CHECK(bsdf.discrete({}, wo, {}).count == 0);
    CHECK_FALSE(bsdf.sample({}, wo, 0.5f, {}, {}));
  }
  for (const EventMask mask : {EventMask::nothing, EventMask::smooth, EventMask::transmit}) {
    CHECK(bsdf.discrete({}, above, {.events = mask}).count == 0);
    CHECK_FALSE(bsdf.sample({}, above, 0.5f, {}, {.events = mask}));
  }
  CHECK(bsdf.sample({}, above, 0.5f, {}, {.events = EventMask::reflect}));
  CHECK(bsdf.roughness({}) == 0);
  CHECK(bsdf.relative_ior() == 1);
}

}  // namespace pharos

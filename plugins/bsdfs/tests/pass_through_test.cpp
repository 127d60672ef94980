#include "../pass_through.h"

#include <doctest/doctest.h>

#include "bsdf_checks.h"

namespace pharos {

TEST_CASE("pass-through: light goes straight on from both sides, or not at all") {
  const PassThrough bsdf;
  for (const double theta : {20.0, 90.0, 150.0}) {
    const Vec3 wo = test::direction(theta, 40);
    const auto s = bsdf.sample({}, wo, 0.7f, {0.2f, 0.9f}, {});
    REQUIRE(s);
    CHECK(s->event == Event::pass_through);
    CHECK(s->direction == -wo);
    CHECK(s->weight == Rgb(1));
    CHECK(s->pdf == 1);
    CHECK(bsdf.evaluate({}, wo, -wo, {}).pdf == 0);
    CHECK_FALSE(bsdf.sample({}, wo, 0.7f, {0.2f, 0.9f}, {.events = EventMask::reflect}));
    CHECK(bsdf.discrete({}, wo, {.events = EventMask::smooth}).count == 0);
  }
  CHECK(bsdf.events() == mask_of(Event::pass_through));
  CHECK(bsdf.relative_ior() == 1);
}

}  // namespace pharos

#include "../two_sided.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "../dielectric.h"
#include "../diffuse.h"
#include "../plastic.h"
#include "../rough_conductor.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

Ref<Bsdf> metal() {
  return std::make_shared<RoughConductor>(RoughConductor::Settings{
      .alpha = 0.4f, .specular_reflectance = test::uniform({0.9f, 0.5f, 0.2f})});
}
Ref<Bsdf> plastic() {
  return std::make_shared<Plastic>(Plastic::Settings{
      .reflectance = test::uniform(Rgb(0.6f)), .specular_reflectance = test::uniform(Rgb(0.8f))});
}
Vec3 mirrored(Vec3 v) {
  return {v.x, v.y, -v.z};
}

}  // namespace

TEST_CASE("two sided: seen from behind it is what it is from the front, mirrored") {
  const SurfacePoint point;
  for (const Ref<Bsdf>& bsdf : {metal(), plastic()}) {
    const TwoSided both({.bsdf = bsdf, .back = nullptr});
    CHECK(both.events() == bsdf->events());
    const Vec3 wo = test::direction(40, 30), wi = test::direction(55, 190);
    for (const bool behind : {false, true}) {
      const auto side = [&](Vec3 v) { return behind ? mirrored(v) : v; };
      const ScatterValue v = both.evaluate(point, side(wo), side(wi), {});
      const ScatterValue expected = bsdf->evaluate(point, wo, wi, {});
      CHECK(v.value == expected.value);
      CHECK(v.pdf == expected.pdf);
      CHECK(both.evaluate(point, side(wo), side(mirrored(wi)), {}).pdf == 0);
      for (const float u : {0.01f, 0.9f}) {
        const auto s = both.sample(point, side(wo), u, {0.4f, 0.2f}, {});
        const auto front = bsdf->sample(point, wo, u, {0.4f, 0.2f}, {});
        REQUIRE(s);
        CHECK(s->direction == side(front->direction));
        CHECK(s->weight == front->weight);
        CHECK(s->event == front->event);
      }
      const DiscreteOutcomes mirror = both.discrete(point, side(wo), {});
      CHECK(mirror.count == bsdf->discrete(point, wo, {}).count);
      for (const DiscreteOutcome& o : mirror) {
        CHECK(o.direction == side(Vec3{-wo.x, -wo.y, wo.z}));
      }
    }
  }
}

TEST_CASE("two sided: another back") {
  const SurfacePoint point;
  const TwoSided both({.bsdf = metal(), .back = plastic()});
  CHECK(both.events() == (mask_of(Event::smooth_reflect) | mask_of(Event::discrete_reflect)));
  const Vec3 wo = test::direction(40, 30);
  CHECK(both.discrete(point, wo, {}).count == 0);
  CHECK(both.discrete(point, mirrored(wo), {}).count == 1);
  CHECK(both.roughness(point) == 0);
  CHECK(both.evaluate(point, mirrored(wo), mirrored(wo), {}).value ==
        plastic()->evaluate(point, wo, wo, {}).value);
}

TEST_CASE("two sided: takes nothing that lets light through") {
  const Ref<Bsdf> glass = std::make_shared<Dielectric>(Dielectric::Settings{});
  CHECK_THROWS_WITH_AS(TwoSided({.bsdf = glass, .back = nullptr}),
                       "bsdf must be opaque, but it lets light through", InputError);
  CHECK_THROWS_WITH_AS(TwoSided({.bsdf = metal(), .back = glass}),
                       "back must be opaque, but it lets light through", InputError);
}

}  // namespace pharos

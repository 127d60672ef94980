#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "../blend.h"
#include "../dielectric.h"
#include "../diffuse.h"
#include "../mask.h"
#include "../plastic.h"
#include "../rough_conductor.h"
#include "../rough_dielectric.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

constexpr EventMask kPass = mask_of(Event::pass_through);

Ref<Bsdf> diffuse(float reflectance) {
  return std::make_shared<Diffuse>(
      Diffuse::Settings{.reflectance = test::uniform(Rgb(reflectance))});
}
Ref<Bsdf> metal() {
  return std::make_shared<RoughConductor>(
      RoughConductor::Settings{.alpha = 0.4f, .specular_reflectance = test::uniform(Rgb(1))});
}
Ref<Bsdf> plastic(float ior = 1.5f) {
  return std::make_shared<Plastic>(
      Plastic::Settings{.ior = ior,
                        .reflectance = test::uniform(Rgb(0.6f)),
                        .specular_reflectance = test::uniform(Rgb(1))});
}
Ref<Bsdf> glass(float ior) {
  const Ref<Texture> all = test::uniform(Rgb(1));
  return std::make_shared<Dielectric>(
      Dielectric::Settings{.ior = ior, .specular_reflectance = all, .specular_transmittance = all});
}
Ref<Bsdf> frosted(float ior) {
  const Ref<Texture> all = test::uniform(Rgb(1));
  return std::make_shared<RoughDielectric>(RoughDielectric::Settings{
      .ior = ior, .specular_reflectance = all, .specular_transmittance = all});
}
Ref<Bsdf> blend(Ref<Bsdf> first, Ref<Bsdf> second, Rgb weight) {
  return std::make_shared<Blend>(
      Blend::Settings{.first = first, .second = second, .weight = test::uniform(weight)});
}
Ref<Bsdf> mask(Ref<Bsdf> bsdf, Rgb opacity) {
  return std::make_shared<Mask>(Mask::Settings{.bsdf = bsdf, .opacity = test::uniform(opacity)});
}

const Vec3 kOut = test::direction(50, 20), kIn = test::direction(30, 170);

/// Checks that both BSDFs give the same results for all sets of allowed events.
void check_same(const Bsdf& a, const Bsdf& b, Vec3 wo) {
  const SurfacePoint point;
  for (const EventMask allowed : {EventMask::all, EventMask::smooth, EventMask::discrete,
                                  EventMask::reflect, EventMask::transmit}) {
    const ScatterOptions options{.events = allowed};
    for (const Vec3 wi : {kIn, -kIn}) {
      const ScatterValue va = a.evaluate(point, wo, wi, options);
      const ScatterValue vb = b.evaluate(point, wo, wi, options);
      CHECK(va.pdf == doctest::Approx(vb.pdf));
      for (int c = 0; c < 3; ++c) CHECK(va.value[c] == doctest::Approx(vb.value[c]));
    }
    const DiscreteOutcomes da = a.discrete(point, wo, options), db = b.discrete(point, wo, options);
    REQUIRE(da.count == db.count);
    for (int i = 0; i < da.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      CHECK(da.outcomes[k].event == db.outcomes[k].event);
      CHECK(da.outcomes[k].direction == db.outcomes[k].direction);
      CHECK(da.outcomes[k].probability == doctest::Approx(db.outcomes[k].probability));
      CHECK(da.outcomes[k].value.g == doctest::Approx(db.outcomes[k].value.g));
    }
  }
}

}  // namespace

TEST_CASE("blend: of a material with itself is that material") {
  for (const Ref<Bsdf>& bsdf : {diffuse(0.7f), metal(), plastic(), glass(1.5f)}) {
    const Ref<Bsdf> both = blend(bsdf, bsdf, {0.2f, 0.5f, 0.8f});
    CHECK(both->events() == bsdf->events());
    CHECK(both->relative_ior() == bsdf->relative_ior());
    CHECK(both->roughness({}) == bsdf->roughness({}));
    for (const Vec3 wo : {kOut, -kOut}) check_same(*both, *bsdf, wo);
  }
}

TEST_CASE("blend: at its ends it is one of both") {
  check_same(*blend(plastic(), metal(), Rgb(0)), *plastic(), kOut);
  check_same(*blend(plastic(), metal(), Rgb(1)), *metal(), kOut);
  CHECK(blend(plastic(), metal(), Rgb(1))->roughness({}) == 0.4f);
  CHECK(blend(plastic(), metal(), Rgb(0.5f))->roughness({}) == 0);
}

TEST_CASE("blend: value and density are linear mixes") {
  const SurfacePoint point;
  const Ref<Bsdf> a = plastic(), b = metal(), both = blend(a, b, {0, 0.3f, 0.9f});
  const ScatterValue va = a->evaluate(point, kOut, kIn, {}), vb = b->evaluate(point, kOut, kIn, {});
  const ScatterValue v = both->evaluate(point, kOut, kIn, {});
  CHECK(v.value.r == doctest::Approx(va.value.r));
  CHECK(v.value.g == doctest::Approx(0.7 * va.value.g + 0.3 * vb.value.g));
  CHECK(v.value.b == doctest::Approx(0.1 * va.value.b + 0.9 * vb.value.b));
  CHECK(v.pdf == doctest::Approx(0.6 * va.pdf + 0.4 * vb.pdf));
  // The metal has no discrete events, so there is no choice among these.
  const DiscreteOutcomes mirror = both->discrete(point, kOut, {.events = EventMask::discrete});
  REQUIRE(mirror.count == 1);
  CHECK(mirror.outcomes[0].probability == 1);
  const DiscreteOutcomes any = both->discrete(point, kOut, {});
  CHECK(any.outcomes[0].probability ==
        doctest::Approx(0.6 * a->discrete(point, kOut, {}).outcomes[0].probability));
}

TEST_CASE("blend: any number of materials by nesting, each with its weight") {
  // Weights 0.2, 0.3 and 0.4 for three materials, and 0.1 for a black one.
  const Ref<Bsdf> a = plastic(), b = metal(), c = diffuse(0.7f);
  const Ref<Bsdf> rest = blend(c, diffuse(0), Rgb(0.1f / 0.5f));
  const Ref<Bsdf> all = blend(a, blend(b, rest, Rgb(0.5f / 0.8f)), Rgb(0.8f));
  const auto value = [](const Ref<Bsdf>& bsdf) {
    return double{bsdf->evaluate({}, kOut, kIn, {}).value.g};
  };
  CHECK(value(all) == doctest::Approx(0.2 * value(a) + 0.3 * value(b) + 0.4 * value(c)));
  CHECK(all->discrete({}, kOut, {}).outcomes[0].value.g ==
        doctest::Approx(0.2 * a->discrete({}, kOut, {}).outcomes[0].value.g));
  test::check_samples(*all, kOut, {});
}

TEST_CASE("blend: discrete events of one kind become one") {
  const SurfacePoint point;
  const Ref<Bsdf> a = plastic(1.3f), b = plastic(1.9f);
  const DiscreteOutcomes all = blend(a, b, Rgb(0.25f))->discrete(point, kOut, {});
  REQUIRE(all.count == 1);
  const DiscreteOutcome of_a = a->discrete(point, kOut, {}).outcomes[0];
  const DiscreteOutcome of_b = b->discrete(point, kOut, {}).outcomes[0];
  CHECK(all.outcomes[0].value.g == doctest::Approx(0.75 * of_a.value.g + 0.25 * of_b.value.g));
  CHECK(all.outcomes[0].probability ==
        doctest::Approx(0.75 * of_a.probability + 0.25 * of_b.probability));
}

TEST_CASE("blend: all three discrete events and two smooth ones at once") {
  const Ref<Bsdf> all = blend(mask(glass(1.5f), Rgb(0.6f)), plastic(), Rgb(0.3f));
  CHECK(all->discrete({}, kOut, {}).count == 3);
  CHECK(all->relative_ior() == doctest::Approx(1 / 1.5));
  test::check_samples(*all, kOut, {});
  test::check_samples(*all, -kOut, {});
}

TEST_CASE("blend: a surface has one index of refraction") {
  CHECK_NOTHROW(blend(glass(1.5f), plastic(1.9f), Rgb(0.5f)));
  CHECK_NOTHROW(blend(glass(1.5f), mask(glass(1.5f), Rgb(0.5f)), Rgb(0.5f)));
  CHECK_THROWS_WITH_AS(blend(glass(1.5f), glass(1.3f), Rgb(0.5f)),
                       "'first' and 'second' must refract alike, but their refractive indices "
                       "inside over outside are 1.5 and 1.3",
                       InputError);
  // An interface of index one refracts straight on.
  CHECK_THROWS_AS(blend(mask(glass(1.5f), Rgb(0.5f)), glass(1), Rgb(0.5f)), InputError);
  CHECK_THROWS_AS(blend(frosted(1.5f), glass(1), Rgb(0.5f)), InputError);
  CHECK_THROWS_AS(blend(glass(1), frosted(1.5f), Rgb(0.5f)), InputError);
  CHECK_NOTHROW(blend(frosted(1.5f), glass(1.5f), Rgb(0.5f)));
}

TEST_CASE("mask: opaque it is its material, and clear it is nothing") {
  for (const Ref<Bsdf>& bsdf : {diffuse(0.7f), metal(), plastic(), glass(1.5f)}) {
    const Ref<Bsdf> opaque = mask(bsdf, Rgb(1));
    CHECK(opaque->events() == (bsdf->events() | kPass));
    CHECK(opaque->relative_ior() == bsdf->relative_ior());
    CHECK(opaque->roughness({}) == bsdf->roughness({}));
    for (const Vec3 wo : {kOut, -kOut}) check_same(*opaque, *bsdf, wo);
    const Ref<Bsdf> clear = mask(bsdf, Rgb(0));
    CHECK(clear->evaluate({}, kOut, kIn, {}).pdf == 0);
    const auto s = clear->sample({}, kOut, 0.7f, {}, {});
    REQUIRE(s);
    CHECK(s->event == Event::pass_through);
    CHECK(s->direction == -kOut);
    CHECK(s->weight == Rgb(1));
    CHECK(s->pdf == 1);
  }
}

TEST_CASE("mask: the share 1 - opacity passes, from both sides") {
  const Rgb opacity{0.2f, 0.5f, 0.8f};
  const Ref<Bsdf> bsdf = mask(plastic(), opacity);
  for (const Vec3 wo : {kOut, -kOut}) {
    const DiscreteOutcomes pass = bsdf->discrete({}, wo, {.events = EventMask::transmit});
    REQUIRE(pass.count == 1);
    CHECK(pass.outcomes[0].event == Event::pass_through);
    CHECK(pass.outcomes[0].direction == -wo);
    CHECK(pass.outcomes[0].value == Rgb(1) - opacity);
    CHECK(pass.outcomes[0].probability == 1);
    CHECK(bsdf->discrete({}, wo, {}).outcomes[0].probability == doctest::Approx(0.5));
  }
  CHECK(bsdf->evaluate({}, kOut, kIn, {.events = EventMask::smooth}).pdf ==
        doctest::Approx(plastic()->evaluate({}, kOut, kIn, {.events = EventMask::smooth}).pdf));
}

TEST_CASE("mask: in a mask is a mask of the product") {
  const Ref<Bsdf> nested = mask(mask(diffuse(0.7f), Rgb(0.4f)), Rgb(0.5f));
  check_same(*nested, *mask(diffuse(0.7f), Rgb(0.2f)), kOut);
}

TEST_CASE("mixtures: samples stay stratified through nested choices") {
  // A quarter of the equidistant numbers belongs to each of the four materials, however they are
  // nested.
  const Ref<Bsdf> left = blend(diffuse(0.1f), mask(diffuse(0.1f), Rgb(0)), Rgb(0.5f));
  const Ref<Bsdf> right = blend(glass(1.5f), metal(), Rgb(0.5f));
  const Ref<Bsdf> all = blend(left, right, Rgb(0.5f));
  int passed = 0, refracted = 0;
  constexpr int kSamples = 64;
  for (int i = 0; i < kSamples; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / kSamples;
    const auto s = all->sample({}, {0, 0, 1}, u, {0.3f, 0.4f}, {});
    REQUIRE(s);
    passed += s->event == Event::pass_through;
    refracted += is_discrete(s->event) && s->event != Event::pass_through;
  }
  CHECK(passed == kSamples / 4);
  CHECK(refracted == kSamples / 4);
  for (const float u : {0.0f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon}) {
    CHECK(all->sample({}, {0, 0, 1}, u, {0.3f, 0.4f}, {}));
  }
}

}  // namespace pharos

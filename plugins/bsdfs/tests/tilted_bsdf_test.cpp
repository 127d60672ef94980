// bump_map and normal_map, and their effect on nested materials.

#include <cmath>

#include <doctest/doctest.h>

#include "../bump_map.h"
#include "../dielectric.h"
#include "../diffuse.h"
#include "../mask.h"
#include "../normal_map.h"
#include "../rough_conductor.h"
#include "../rough_dielectric.h"
#include "../two_sided.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

/// A texture that rises evenly with u and v.
class Ramp final : public Texture {
 public:
  explicit Ramp(Vec2 slope) : slope_(slope) {}
  Rgb value_at(const SurfacePoint& point) const override {
    return Rgb(4 + slope_.x * point.uv.x + slope_.y * point.uv.y);
  }
  Rgb maximum() const override { return Rgb(8); }
  Rgb average() const override { return Rgb(4); }

 private:
  Vec2 slope_;
};

Ref<Bsdf> brushed() {
  return std::make_shared<RoughConductor>(RoughConductor::Settings{
      .alpha = 0.2f, .alpha_v = 0.5f, .specular_reflectance = test::uniform({0.9f, 0.6f, 0.3f})});
}
Ref<Bsdf> frosted() {
  return std::make_shared<RoughDielectric>(
      RoughDielectric::Settings{.alpha = 0.3f,
                                .specular_reflectance = test::uniform(Rgb(1)),
                                .specular_transmittance = test::uniform(Rgb(1))});
}
Ref<Bsdf> glass() {
  return std::make_shared<Dielectric>(
      Dielectric::Settings{.specular_reflectance = test::uniform(Rgb(1)),
                           .specular_transmittance = test::uniform(Rgb(1))});
}
Ref<Bsdf> matt() {
  return std::make_shared<Diffuse>(Diffuse::Settings{.reflectance = test::uniform(Rgb(1))});
}

BumpMap bumps(Ref<Bsdf> bsdf, Vec2 slope, float height = 1) {
  return BumpMap({.bsdf = std::move(bsdf),
                  .texture = std::make_shared<Ramp>(slope),
                  .height = height,
                  .step = 0.05f});
}
NormalMap normals(Ref<Bsdf> bsdf, Rgb color) {
  return NormalMap({.bsdf = std::move(bsdf), .texture = test::uniform(color)});
}

/// A point on the plane z = 0, where x = 2 u and y = 3 v.
SurfacePoint plane_point() {
  SurfacePoint point{.normal = {0, 0, 1}, .uv = {0.3f, 0.4f}};
  point.set_tangents({{2, 0, 0}, {0, 3, 0}});
  return point;
}

void check_same(const ScatterValue& a, const ScatterValue& b) {
  for (int c = 0; c < 3; ++c) CHECK(a.value[c] == doctest::Approx(b.value[c]).epsilon(1e-3));
  CHECK(a.pdf == doctest::Approx(b.pdf).epsilon(1e-3));
}

}  // namespace

TEST_CASE("bump map and normal map: flat ones change nothing, to the bit") {
  const Vec3 wo = test::direction(35, 20);
  for (const Ref<Bsdf>& bsdf : {brushed(), frosted(), glass()}) {
    const BumpMap bump = bumps(bsdf, {0, 0});
    const NormalMap map = normals(bsdf, {0.5f, 0.5f, 1});
    for (const Bsdf* flat : {static_cast<const Bsdf*>(&bump), static_cast<const Bsdf*>(&map)}) {
      for (const Transport transport : {Transport::radiance, Transport::importance}) {
        const Vec3 wi = test::direction(50, 190);
        const ScatterValue v = flat->evaluate(plane_point(), wo, wi, {transport});
        const ScatterValue expected = bsdf->evaluate(plane_point(), wo, wi, {transport});
        CHECK(v.value == expected.value);
        CHECK(v.pdf == expected.pdf);
        const auto s = flat->sample(plane_point(), wo, 0.3f, {0.2f, 0.7f}, {transport});
        const auto t = bsdf->sample(plane_point(), wo, 0.3f, {0.2f, 0.7f}, {transport});
        REQUIRE(s);
        CHECK(s->direction == t->direction);
        CHECK(s->weight == t->weight);
      }
    }
  }
}

TEST_CASE("bump map: a slope is shaded as the plane that it stands for") {
  const Vec2 slope{0.8f, -0.9f};
  const BumpMap bump = bumps(brushed(), slope, 0.5f);
  // Tangents, normal and frame of the displaced plane itself.
  const Vec3 du{2, 0, 0.5f * slope.x}, dv{0, 3, 0.5f * slope.y};
  SurfacePoint tilted{.normal = normalize(cross(du, dv)), .uv = {0.3f, 0.4f}};
  tilted.shading.n = tilted.normal;
  tilted.set_tangents({du, dv});
  RandomStream random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 wo = test::direction(60.0 * random.next_1d(), 360.0 * random.next_1d());
    const Vec3 wi = test::direction(60.0 * random.next_1d(), 360.0 * random.next_1d());
    check_same(
        bump.evaluate(plane_point(), wo, wi, {}),
        brushed()->evaluate(tilted, tilted.shading.to_local(wo), tilted.shading.to_local(wi), {}));
  }
}

TEST_CASE("normal map: shaded about the normal it states, on mirrored coordinates too") {
  const Vec3 n = normalize(Vec3{0.3f, -0.2f, 0.8f});
  const Rgb color{0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z};
  const Vec3 wo = test::direction(35, 20), wi = test::direction(40, 120);
  const NormalMap map = normals(matt(), color);
  CHECK(map.evaluate(plane_point(), wo, wi, {}).value.g == doctest::Approx(dot(wi, n) / kPi));
  SurfacePoint mirrored = plane_point();
  mirrored.set_tangents({{2, 0, 0}, {0, -3, 0}});
  CHECK(map.evaluate(mirrored, wo, wi, {}).value.g ==
        doctest::Approx(dot(wi, Vec3{n.x, -n.y, n.z}) / kPi));
  SurfacePoint unmapped = plane_point();
  unmapped.tangents = {};
  CHECK(map.evaluate(unmapped, wo, wi, {}).value.g == doctest::Approx(wi.z / kPi));
}

TEST_CASE("tilted materials: samples are those of the density, on either side") {
  for (const Ref<Bsdf>& bsdf : {brushed(), frosted(), matt()}) {
    const BumpMap bump = bumps(bsdf, {1.5f, 1});
    for (const double theta : {20.0, 70.0, 130.0}) {
      for (const Transport transport : {Transport::radiance, Transport::importance}) {
        const Vec3 wo = test::direction(theta, 200);
        const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
          const float choice = random.next_1d();
          const auto s = bump.sample(plane_point(), wo, choice, random.next_2d(), {transport});
          return s && !is_discrete(s->event) ? std::optional(s->direction) : std::nullopt;
        };
        const auto density = [&](Vec3 wi) {
          return double{bump.evaluate(plane_point(), wo, wi, {transport}).pdf};
        };
        const auto fit = statistics::fit_direction_density(draw, density, {.seed = 7});
        CHECK(fit.chi_square.p_value > 1e-4);
      }
    }
  }
}

TEST_CASE("tilted materials: no light through the surface, whatever the map") {
  RandomStream random(8);
  for (const Rgb color : {Rgb(1, 0.5f, 0.5f), Rgb(0.9f, 0.1f, 0.2f), Rgb(0.5f, 0.5f, 0)}) {
    const NormalMap map = normals(matt(), color);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 wo = test::direction(180.0 * random.next_1d(), 360.0 * random.next_1d());
      const auto s = map.sample(plane_point(), wo, random.next_1d(), random.next_2d(), {});
      if (!s) continue;
      CHECK(s->direction.z > 0);
      CHECK(wo.z > 0);
      CHECK(is_finite(s->weight));
      const Vec3 below{s->direction.x, s->direction.y, -s->direction.z};
      CHECK(map.evaluate(plane_point(), wo, below, {}).pdf == 0);
    }
  }
}

TEST_CASE("tilted materials: importance is the adjoint of radiance") {
  const BumpMap bump = bumps(frosted(), {0.9f, -0.6f});
  RandomStream random(9);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 wo = test::direction(180.0 * random.next_1d(), 360.0 * random.next_1d());
    const Vec3 wi = test::direction(180.0 * random.next_1d(), 360.0 * random.next_1d());
    const double forth = bump.evaluate(plane_point(), wo, wi, {}).value.g / std::abs(wi.z);
    const double back =
        bump.evaluate(plane_point(), wi, wo, {Transport::importance}).value.g / std::abs(wo.z);
    if (forth > 1e-4) ++compared;
    CHECK(back == doctest::Approx(forth).epsilon(2e-3));
  }
  CHECK(compared > 100);
}

TEST_CASE("tilted materials: mirrors turn by twice the tilt, holes let light straight through") {
  const NormalMap tilted = normals(glass(), {0.6f, 0.5f, 0.95f});
  const Vec3 n = normalize(Vec3{0.2f, 0, 0.9f}), wo = test::direction(20, 100);
  const DiscreteOutcomes outcomes = tilted.discrete(plane_point(), wo, {});
  REQUIRE(outcomes.count == 2);
  for (const DiscreteOutcome& o : outcomes) {
    if (o.event != Event::discrete_reflect) continue;
    CHECK(length(o.direction - (2 * dot(wo, n) * n - wo)) < 1e-5f);
  }
  const NormalMap holes = normals(
      std::make_shared<Mask>(Mask::Settings{.bsdf = matt(), .opacity = test::uniform(Rgb(0.5f))}),
      {0.6f, 0.5f, 0.95f});
  const DiscreteOutcomes straight = holes.discrete(plane_point(), wo, {});
  REQUIRE(straight.count == 1);
  CHECK(straight.begin()->direction == -wo);
}

TEST_CASE("materials of materials ask for what their parts ask for") {
  const auto bump = std::make_shared<BumpMap>(
      BumpMap::Settings{.bsdf = matt(), .texture = test::uniform(Rgb(1))});
  const TwoSided both({.bsdf = matt(), .back = bump});
  const Mask holes({.bsdf = bump, .opacity = test::uniform(Rgb(0.5f))});
  const Mask plain({.bsdf = matt(), .opacity = test::uniform(Rgb(0.5f))});
  for (const Bsdf* bsdf : {static_cast<const Bsdf*>(&both), static_cast<const Bsdf*>(&holes)}) {
    CHECK(bsdf->needs_tangents());
    CHECK(bsdf->tilts_normal());
  }
  CHECK_FALSE(plain.needs_tangents());
  CHECK_FALSE(plain.tilts_normal());
}

}  // namespace pharos

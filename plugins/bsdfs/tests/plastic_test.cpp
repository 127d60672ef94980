#include "../plastic.h"

#include <doctest/doctest.h>

#include "../diffuse.h"
#include "../fresnel.h"
#include "../hemisphere_mean.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

Plastic::Settings settings(Rgb reflectance, float ior = 1.5f, bool nonlinear = true) {
  return {.ior = ior,
          .reflectance = test::uniform(reflectance),
          .specular_reflectance = test::uniform(Rgb(1)),
          .nonlinear = nonlinear};
}

/// All reflected light, mean of the channels.
double reflected(const Plastic& bsdf, Vec3 wo) {
  return test::smooth_albedo(bsdf, wo) + mean(bsdf.discrete({}, wo, {}).outcomes[0].value);
}

}  // namespace

TEST_CASE("plastic: a white base reflects all light, at any angle and index") {
  for (const float ior : {1.0f, 1.3f, 1.5f, 2.4f}) {
    const Plastic bsdf(settings(Rgb(1), ior));
    for (const double theta : {0.0, 45.0, 80.0, 89.0}) {
      CAPTURE(ior);
      CAPTURE(theta);
      CHECK(reflected(bsdf, test::direction(theta, 20)) == doctest::Approx(1).epsilon(2e-5));
    }
    CHECK(bsdf.albedo({}).g == doctest::Approx(1));
  }
}

TEST_CASE("plastic: repeated reflection under a coat of large index") {
  // Nearly all light that has entered stays until it is absorbed: (1 - F') a / (1 - a).
  const Plastic bsdf(settings(Rgb(0.5f), 100));
  const float outside =
      hemisphere_mean([](float c) { return dielectric_fresnel(c, 100).reflectance; });
  const double escaping = (1 - double{outside}) / 1e4;
  const double emerging = escaping * 0.5 / (0.5 + 0.5 * escaping);
  const Vec3 wo{0, 0, 1};
  const double entering = 1 - double{dielectric_fresnel(1, 100).reflectance};
  CHECK(test::smooth_albedo(bsdf, wo) == doctest::Approx(entering * emerging).epsilon(1e-3));
  CHECK(reflected(Plastic(settings(Rgb(1), 100)), wo) == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("plastic: the average reflectances of Fresnel's equations") {
  // Duntley 1942: a surface of index 1.5 reflects 9.2 % of diffuse light outside, and 59.6 %
  // inside.
  const float outside =
      hemisphere_mean([](float c) { return dielectric_fresnel(c, 1.5f).reflectance; });
  CHECK(outside == doctest::Approx(0.0918).epsilon(1e-3));
  const double inside = 1 - (1 - double{outside}) / 2.25;
  CHECK(inside == doctest::Approx(0.5963).epsilon(1e-3));
  // Saunderson's correction (1942) at normal incidence.
  const double saunderson = 0.04 + 0.96 * (1 - inside) * 0.3 / (1 - 0.3 * inside);
  const Vec3 wo{0, 0, 1};
  CHECK(reflected(Plastic(settings(Rgb(0.3f))), wo) == doctest::Approx(saunderson).epsilon(1e-4));
  CHECK(reflected(Plastic(settings(Rgb(0.3f), 1.5f, false)), wo) ==
        doctest::Approx(0.04 + 0.96 * 0.3).epsilon(1e-4));
}

TEST_CASE("plastic: the formula of the base") {
  const Plastic bsdf(settings({0.2f, 0.5f, 0.9f}, 1.7f));
  const Vec3 wo = test::direction(65, 0), wi = test::direction(30, 120);
  const auto fresnel = [](float c) { return double{dielectric_fresnel(c, 1.7f).reflectance}; };
  const double outside = hemisphere_mean(fresnel), inside = 1 - (1 - outside) / (1.7 * 1.7);
  const ScatterValue v = bsdf.evaluate({}, wo, wi, {});
  for (int c = 0; c < 3; ++c) {
    const double a = Rgb(0.2f, 0.5f, 0.9f)[c];
    const double f = (1 - fresnel(wo.z)) * (1 - fresnel(wi.z)) * a / (1 - a * inside);
    CHECK(v.value[c] == doctest::Approx(f * wi.z / (M_PI * 1.7 * 1.7)).epsilon(1e-4));
  }
}

TEST_CASE("plastic: of index one it is its base") {
  const Plastic bsdf(settings(Rgb(0.4f), 1));
  const Vec3 wo = test::direction(40, 0), wi = test::direction(70, 100);
  const ScatterValue v = bsdf.evaluate({}, wo, wi, {});
  const ScatterValue base =
      Diffuse({.reflectance = test::uniform(Rgb(0.4f))}).evaluate({}, wo, wi, {});
  CHECK(v.value.r == doctest::Approx(base.value.r));
  CHECK(v.pdf == doctest::Approx(base.pdf));
  CHECK(bsdf.discrete({}, wo, {}).count == 0);
}

TEST_CASE("plastic: coat and base are chosen by what they reflect, and by what is allowed") {
  const Plastic bsdf(settings(Rgb(0.5f), 1.5f, false));
  const Vec3 wo{0, 0, 1};
  const float coat = 0.04f / (0.04f + 0.96f * 0.5f);
  const DiscreteOutcomes all = bsdf.discrete({}, wo, {});
  REQUIRE(all.count == 1);
  CHECK(all.outcomes[0].probability == doctest::Approx(coat));
  CHECK(all.outcomes[0].value.g == doctest::Approx(0.04));
  CHECK(bsdf.evaluate({}, wo, wo, {}).pdf == doctest::Approx((1 - coat) / M_PI));

  const ScatterOptions smooth{.events = EventMask::smooth}, discrete{.events = EventMask::discrete};
  CHECK(bsdf.evaluate({}, wo, wo, smooth).pdf == doctest::Approx(1 / M_PI));
  CHECK(bsdf.discrete({}, wo, smooth).count == 0);
  CHECK(bsdf.discrete({}, wo, discrete).outcomes[0].probability == 1);
  CHECK(bsdf.sample({}, wo, 0.9f, {}, discrete)->event == Event::discrete_reflect);
  CHECK(bsdf.sample({}, wo, 0, {0.3f, 0.3f}, smooth)->event == Event::smooth_reflect);
}

}  // namespace pharos

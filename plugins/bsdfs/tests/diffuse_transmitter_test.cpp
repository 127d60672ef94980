#include "../diffuse_transmitter.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "bsdf_checks.h"

namespace pharos {
namespace {

DiffuseTransmitter sheet(Rgb transmittance, Rgb reflectance) {
  return DiffuseTransmitter(
      {.transmittance = test::uniform(transmittance), .reflectance = test::uniform(reflectance)});
}

/// A texture with one color on the left and another on the right.
class Halves final : public Texture {
 public:
  Rgb value_at(const SurfacePoint& point) const override {
    return point.uv.x < 0.5f ? Rgb(0.6f, 0.2f, 0) : Rgb(0.6f, 0.4f, 0);
  }
  Rgb maximum() const override { return {0.6f, 0.4f, 0}; }
  Rgb average() const override { return {0.6f, 0.3f, 0}; }
};

}  // namespace

TEST_CASE("diffuse transmitter: Lambert's law on both sides, from both sides") {
  const DiffuseTransmitter bsdf = sheet({0.1f, 0.6f, 0.3f}, {0.4f, 0.2f, 0.3f});
  const SurfacePoint point;
  for (const double theta : {25.0, 155.0}) {
    const Vec3 wo = test::direction(theta, 50);
    const Vec3 same = test::direction(theta < 90 ? 60 : 120, 0);
    const Vec3 other{same.x, same.y, -same.z};
    CHECK(bsdf.evaluate(point, wo, same, {}).value.r == doctest::Approx(0.4 * 0.5 / M_PI));
    CHECK(bsdf.evaluate(point, wo, other, {}).value.g == doctest::Approx(0.6 * 0.5 / M_PI));
    // Means of the channels: 0.3 is reflected, 1/3 is transmitted.
    CHECK(test::smooth_albedo(bsdf, wo) == doctest::Approx(0.3 + 1 / 3.0).epsilon(1e-4));
    CHECK(bsdf.evaluate(point, wo, same, {}).pdf ==
          doctest::Approx(0.5 / M_PI * 0.3 / (0.3 + 1 / 3.0)));
    const ScatterOptions through{.events = EventMask::transmit};
    CHECK(bsdf.evaluate(point, wo, other, through).pdf == doctest::Approx(0.5 / M_PI));
    CHECK(bsdf.evaluate(point, wo, same, through).pdf == 0);
  }
  CHECK(bsdf.albedo(point) == Rgb(0.4f, 0.2f, 0.3f) + Rgb(0.1f, 0.6f, 0.3f));
}

TEST_CASE("diffuse transmitter: its events are those that can occur") {
  CHECK(sheet(Rgb(0.5f), Rgb(0)).events() == mask_of(Event::smooth_transmit));
  CHECK(sheet(Rgb(0), Rgb(0.5f)).events() == mask_of(Event::smooth_reflect));
  const DiffuseTransmitter black = sheet(Rgb(0), Rgb(0));
  CHECK(black.events() == EventMask::nothing);
  CHECK_FALSE(black.sample({}, test::direction(20, 0), 0.5f, {0.3f, 0.6f}, {}));
  CHECK_FALSE(sheet(Rgb(0.3f), Rgb(0.7f)).sample({}, {1, 0, 0}, 0.5f, {0.3f, 0.6f}, {}));
}

TEST_CASE("diffuse transmitter: gives no light away") {
  CHECK_NOTHROW(sheet(Rgb(0.3f), Rgb(0.7f)));
  CHECK_NOTHROW(sheet({0.1f, 0.8f, 0}, {0.9f, 0.2f, 1}));
  CHECK_THROWS_WITH_AS(sheet(Rgb(0.3f), {0.1f, 0.8f, 0}),
                       "transmittance and reflectance must not add up to more than 1, but their "
                       "largest values are 0.3 and 0.8",
                       InputError);
  // For a texture that varies, its largest value in the same channel counts.
  const auto build = [](Rgb reflectance) {
    return DiffuseTransmitter(
        {.transmittance = std::make_shared<Halves>(), .reflectance = test::uniform(reflectance)});
  };
  CHECK_NOTHROW(build({0.4f, 0.6f, 1}));
  CHECK_THROWS_WITH_AS(build({0, 0.7f, 0}), doctest::Contains("are 0.4 and 0.7"), InputError);
}

TEST_CASE("diffuse transmitter: samples follow the density of either map") {
  for (const HemisphereWarp warp : {HemisphereWarp::concentric, HemisphereWarp::octahedral}) {
    const DiffuseTransmitter bsdf({.transmittance = test::uniform(Rgb(0.5f)),
                                   .reflectance = test::uniform(Rgb(0.3f)),
                                   .warp = warp});
    const Vec3 wo = test::direction(130, 20);
    const auto fit = test::fit_smooth(bsdf, wo, {}, 5);
    CHECK(fit.is_density());
    CHECK(fit.integral == doctest::Approx(1).epsilon(2e-3));
    CHECK(fit.chi_square.p_value > 1e-3);
    test::check_samples(bsdf, wo, {});
  }
}

}  // namespace pharos

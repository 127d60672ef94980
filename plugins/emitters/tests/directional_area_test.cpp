#include "../directional_area.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>

#include "axial_integral.h"
#include "ceiling.h"

namespace pharos {
namespace {

using Settings = DirectionalAreaEmitter::Settings;

struct LitCeiling {
  Ceiling shape;
  DirectionalAreaEmitter emitter;
  std::unique_ptr<const Light> light;

  explicit LitCeiling(Settings settings)
      : emitter(std::move(settings)), light(emitter.place({.shape = &shape, .object = 7})) {}

  /// The radiance in a direction at `cosine` to the normal.
  double at_cosine(double cosine) const {
    const auto sine = static_cast<float>(std::sqrt(1 - cosine * cosine));
    return light->radiance(shape.sample({0.2f, 0.7f}).point, {0, sine, static_cast<float>(-cosine)})
        .r;
  }
};

Settings cosine_power(float exponent, float scale = 1) {
  return {
      .radiance = std::make_shared<const OneColor>(Rgb(2)), .exponent = exponent, .scale = scale};
}
Settings von_mises_fisher(float concentration) {
  return {.radiance = std::make_shared<const OneColor>(Rgb(2)),
          .lobe = EmissionLobe::von_mises_fisher,
          .concentration = concentration};
}

}  // namespace

TEST_CASE("directional_area: radiance is the peak of the lobe") {
  const LitCeiling power(cosine_power(20, 3)), fisher(von_mises_fisher(50));
  for (const double c : {1.0, 0.99, 0.8, 0.3}) {
    CHECK(power.at_cosine(c) == doctest::Approx(6 * std::pow(c, 20)).epsilon(1e-4));
    CHECK(fisher.at_cosine(c) == doctest::Approx(2 * std::exp(50 * (c - 1))).epsilon(1e-4));
  }
  CHECK(power.at_cosine(-1) == 0);
  CHECK(fisher.at_cosine(-0.5) == 0);
  CHECK(fisher.at_cosine(0) == 0);
}

TEST_CASE("directional_area: never more than the peak where a direction is rounded up") {
  for (const Settings& settings : {cosine_power(1e5f), von_mises_fisher(1e5f)}) {
    const LitCeiling ceiling(settings);
    const SurfacePoint point = ceiling.shape.sample({0.2f, 0.7f}).point;
    CHECK(ceiling.light->radiance(point, {0, 0, -1 - 1.2e-7f}) == Rgb(2));
  }
}

TEST_CASE("directional_area: power is the integral over area and hemisphere") {
  for (const Settings& settings :
       {cosine_power(0), cosine_power(1), cosine_power(300, 2), von_mises_fisher(0),
        von_mises_fisher(2e-4f), von_mises_fisher(1), von_mises_fisher(500)}) {
    const LitCeiling ceiling(settings);
    const double exact = 8 * axial_integral([&](double angle) {
                           return ceiling.at_cosine(std::cos(angle)) * std::cos(angle);
                         });
    CHECK(ceiling.light->power() == doctest::Approx(exact).epsilon(1e-4));
  }
}

TEST_CASE("directional_area: sampled irradiance is the integral over the surface") {
  const LitCeiling ceiling(cosine_power(20));
  for (const Point3 at : {Point3{0, 0, 0}, Point3{0.9f, 1, 2}}) {
    // The cosines at both ends are height / distance.
    const auto on_ceiling = [&](double x, double y) {
      const double height = 3 - double{at.z};
      const double square = (x - at.x) * (x - at.x) + (y - at.y) * (y - at.y) + height * height;
      const double c = height / std::sqrt(square);
      return 2 * std::pow(c, 20) * c * c / square;
    };
    const double exact = statistics::integrate(on_ceiling, {-1, 1, -2, 2}).value;
    double sum = 0;
    constexpr int count = 200;
    for (int i = 0; i < count * count; ++i) {
      const Vec2 u{(i % count + 0.5f) / count, (i / count + 0.5f) / count};
      const LightSample s = ceiling.light->sample(at, u);
      sum += double{s.radiance.r} * s.direction.z / s.pdf / (count * count);
    }
    CHECK(sum == doctest::Approx(exact).epsilon(1e-3));
  }
}

TEST_CASE("directional_area: directions follow the density that is claimed for points") {
  const LitCeiling ceiling(von_mises_fisher(30));
  const Point3 from{0.5f, 0.25f, 1};
  const auto density = [&](Vec3 d) -> double {
    if (d.z <= 0) return 0;
    SurfacePoint point = ceiling.shape.sample({}).point;
    point.position = from + 2 / d.z * d;
    const bool met = std::abs(point.position.x) < 1 && std::abs(point.position.y) < 2;
    return met ? ceiling.light->pdf_point(from, point) : 0;
  };
  const auto fit = statistics::fit_direction_density(
      [&](RandomStream& random) -> std::optional<Vec3> {
        return ceiling.light->sample(from, random.next_2d()).direction;
      },
      density, {.draws = 40'000, .cells = 60, .quadrature_tolerance = 1e-3});
  CHECK(fit.chi_square.p_value > 1e-4);
  CHECK(fit.integral == doctest::Approx(1).epsilon(3e-3));
}

TEST_CASE("directional_area: each lobe takes its own parameter") {
  const auto build = [](EmissionLobe lobe, std::optional<float> exponent,
                        std::optional<float> concentration) {
    DirectionalAreaEmitter({.radiance = std::make_shared<const OneColor>(Rgb(1)),
                            .lobe = lobe,
                            .exponent = exponent,
                            .concentration = concentration});
  };
  CHECK_NOTHROW(build(EmissionLobe::cosine_power, 3, {}));
  CHECK_NOTHROW(build(EmissionLobe::von_mises_fisher, {}, 3));
  for (const auto& [exponent, concentration] :
       {std::pair<std::optional<float>, std::optional<float>>{}, {3, 3}}) {
    CHECK_THROWS_WITH_AS(build(EmissionLobe::cosine_power, exponent, concentration),
                         doctest::Contains("takes 'exponent' and no 'concentration'"), InputError);
    CHECK_THROWS_WITH_AS(build(EmissionLobe::von_mises_fisher, exponent, concentration),
                         doctest::Contains("takes 'concentration' and no 'exponent'"), InputError);
  }
}

}  // namespace pharos

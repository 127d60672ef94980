#include "bsdf_checks.h"

#include <bit>
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/quadrature.h>

extern "C" void pharos_module_register(pharos::Registry& registry);

namespace pharos::test {
namespace {

void check_close(Rgb a, Rgb b) {
  for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(1e-5));
}

double tangent_squared(Vec3 v) {
  return (double{v.x} * v.x + double{v.y} * v.y) / (double{v.z} * v.z);
}

}  // namespace

void UniformTexture::Settings::describe(Schema<Settings>& s) {
  s.field("value", &Settings::value, "The value");
}

Ref<Texture> uniform(Rgb value) {
  return std::make_shared<UniformTexture>(UniformTexture::Settings{value});
}

const Registry& registry() {
  static const Registry all = [] {
    Registry r;
    r.add<UniformTexture>("uniform", "The same everywhere");
    r.set_shorthand<Texture>("uniform", "value");
    pharos_module_register(r);
    return r;
  }();
  return all;
}

Ref<Bsdf> build(const std::string& yaml, BuildContext context) {
  ConfigNode resolved;
  return registry().build<Bsdf>(parse_yaml(yaml, "test"), context, resolved);
}

Vec3 direction(double theta, double phi) {
  const double t = theta * M_PI / 180, p = phi * M_PI / 180;
  return {static_cast<float>(std::sin(t) * std::cos(p)),
          static_cast<float>(std::sin(t) * std::sin(p)), static_cast<float>(std::cos(t))};
}

double ggx(Vec3 m, double alpha) {
  const double c2 = double{m.z} * m.z, t = alpha * alpha + tangent_squared(m);
  return alpha * alpha / (M_PI * c2 * c2 * t * t);
}

double smith_lambda(Vec3 w, double alpha) {
  return 0.5 * (std::sqrt(1 + alpha * alpha * tangent_squared(w)) - 1);
}

double beckmann(Vec3 m, double alpha) {
  const double c2 = double{m.z} * m.z;
  return std::exp(-tangent_squared(m) / (alpha * alpha)) / (M_PI * alpha * alpha * c2 * c2);
}

double beckmann_lambda(Vec3 w, double alpha) {
  const double a = 1 / (alpha * std::sqrt(tangent_squared(w)));
  return 0.5 * (std::exp(-a * a) / (a * std::sqrt(M_PI)) - std::erfc(a));
}

statistics::DensityFit fit_smooth(const Bsdf& bsdf, Vec3 wo, ScatterOptions options,
                                  std::uint64_t seed) {
  const SurfacePoint point;
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    const float u_choice = random.next_1d();
    const auto s = bsdf.sample(point, wo, u_choice, random.next_2d(), options);
    if (!s || is_discrete(s->event)) return std::nullopt;
    return s->direction;
  };
  const auto density = [&](Vec3 wi) { return double{bsdf.evaluate(point, wo, wi, options).pdf}; };
  return statistics::fit_direction_density(draw, density, {.seed = seed});
}

void check_samples(const Bsdf& bsdf, Vec3 wo, ScatterOptions options) {
  const SurfacePoint point;
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    const float u_choice = random.next_1d();
    const auto s = bsdf.sample(point, wo, u_choice, random.next_2d(), options);
    if (!s) continue;
    REQUIRE(contains(options.events & bsdf.events(), s->event));
    REQUIRE(std::has_single_bit(static_cast<std::uint8_t>(s->event)));
    REQUIRE(is_finite(s->weight));
    REQUIRE(s->pdf > 0);
    CHECK(length(s->direction) == doctest::Approx(1).epsilon(1e-5));
    if (is_discrete(s->event)) {
      for (const DiscreteOutcome& o : bsdf.discrete(point, wo, options)) {
        if (o.event != s->event) continue;
        CHECK(o.probability == s->pdf);
        CHECK(o.direction == s->direction);
        check_close(s->weight, o.value / o.probability);
      }
    } else {
      const ScatterValue v = bsdf.evaluate(point, wo, s->direction, options);
      CHECK(v.pdf == doctest::Approx(s->pdf).epsilon(1e-5));
      check_close(s->weight, v.value / v.pdf);
    }
  }
}

double smooth_albedo(const Bsdf& bsdf, Vec3 wo, ScatterOptions options) {
  const SurfacePoint point;
  const auto value = [&](Vec3 wi) {
    return double{mean(bsdf.evaluate(point, wo, wi, options).value)};
  };
  return statistics::integrate_sphere(value, {.tolerance = 1e-4}, 64, 64).value;
}

}  // namespace pharos::test

#include "../rough_dielectric.h"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/statistics/hypothesis.h>
#include <pharos/statistics/quadrature.h>

#include "../dielectric.h"
#include "../fresnel.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

constexpr EventMask kReflect = EventMask::reflect, kTransmit = EventMask::transmit;

RoughDielectric frosted(float alpha, float ior, Masking masking = Masking::height_correlated,
                        FacetDistribution distribution = FacetDistribution::ggx) {
  return RoughDielectric({.alpha = alpha,
                          .distribution = distribution,
                          .ior = ior,
                          .masking = masking,
                          .specular_reflectance = test::uniform(Rgb(1)),
                          .specular_transmittance = test::uniform(Rgb(1))});
}

/// Glass and gaps in glass, from nearly smooth to rough, with a high or a very low contrast of
/// indices.
std::array<RoughDielectric, 7> subjects() {
  constexpr auto kBeckmann = FacetDistribution::beckmann;
  return {frosted(0.05f, 1.5f),
          frosted(0.3f, 1 / 1.5f),
          frosted(1, 1.5f),
          frosted(0.5f, 2.4f, Masking::separable),
          frosted(0.2f, 1.02f),
          frosted(0.6f, 1.5f, Masking::height_correlated, kBeckmann),
          frosted(0.1f, 1 / 1.8f, Masking::separable, kBeckmann)};
}

/// Directions outside and inside, including one beyond the critical angle of glass.
const std::vector<Vec3> kOutgoing{test::direction(0, 0), test::direction(60, 200),
                                  test::direction(87, -30), test::direction(160, 100),
                                  test::direction(125, 10)};

/// The total share of light that is scattered [1].
double total(const RoughDielectric& bsdf, Vec3 wo) {
  const auto value = [&](Vec3 wi) {
    return double{bsdf.evaluate({}, wo, wi, {.transport = Transport::importance}).value.g};
  };
  return statistics::integrate_sphere(value, {.tolerance = 1e-4}, 64, 64).value;
}

}  // namespace

TEST_CASE("rough dielectric: refraction by the textbook") {
  // Walter et al. 2007, eq. 21, with G1 of eq. 23 or the beta function.
  struct Vector {
    double x, y, z;
  };
  const double alpha = 0.4, eta = 1.5;
  const Vec3 wo = test::direction(50, 20), wi = test::direction(140, 230);
  const Vector h{-(wo.x + eta * wi.x), -(wo.y + eta * wi.y), -(wo.z + eta * wi.z)};
  const double norm = std::sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
  const double o_m = (h.x * wo.x + h.y * wo.y + h.z * wo.z) / norm;
  const double i_m = (h.x * wi.x + h.y * wi.y + h.z * wi.z) / norm;
  const Vec3 m{static_cast<float>(h.x / norm), static_cast<float>(h.y / norm),
               static_cast<float>(h.z / norm)};
  const double fresnel = dielectric_fresnel(static_cast<float>(o_m), 1.5f).reflectance;
  const double denominator = std::pow(o_m + eta * i_m, 2);
  const auto check = [&](FacetDistribution distribution, double d, double lo, double li) {
    const double correlated = std::exp(std::lgamma(lo) + std::lgamma(li) - std::lgamma(lo + li));
    const double unmasked = -o_m * i_m / wo.z * (1 - fresnel) * d / denominator;
    const auto value = [&](Masking masking, Transport transport) {
      return frosted(0.4f, 1.5f, masking, distribution)
          .evaluate({}, wo, wi, {.transport = transport})
          .value.g;
    };
    CHECK(value(Masking::separable, Transport::radiance) ==
          doctest::Approx(unmasked / (lo * li)).epsilon(1e-4));
    CHECK(value(Masking::separable, Transport::importance) ==
          doctest::Approx(unmasked / (lo * li) * eta * eta).epsilon(1e-4));
    CHECK(value(Masking::height_correlated, Transport::radiance) ==
          doctest::Approx(unmasked * correlated).epsilon(1e-4));
  };
  check(FacetDistribution::ggx, test::ggx(m, alpha), 1 + test::smith_lambda(wo, alpha),
        1 + test::smith_lambda(-wi, alpha));
  check(FacetDistribution::beckmann, test::beckmann(m, alpha), 1 + test::beckmann_lambda(wo, alpha),
        1 + test::beckmann_lambda(-wi, alpha));
}

TEST_CASE("rough dielectric: samples follow their density") {
  std::vector<double> p_values;
  std::uint64_t seed = 0;
  for (const RoughDielectric& bsdf : subjects()) {
    for (const Vec3 wo : kOutgoing) {
      for (const EventMask mask : {EventMask::all, kReflect, kTransmit}) {
        const bool oblique = std::abs(wo.z) > 0.1f && std::abs(wo.z) < 0.6f;
        if (mask != EventMask::all && !oblique) continue;
        const auto fit = test::fit_smooth(bsdf, wo, {.events = mask}, ++seed);
        INFO("alpha " << bsdf.roughness({}) << ", index " << 1 / bsdf.relative_ior() << ", cosine "
                      << wo.z << ", events " << static_cast<int>(mask) << ": integral "
                      << fit.integral << ", missed " << fit.missed);
        CHECK(fit.is_density());
        CHECK(std::abs(fit.missed - (1 - fit.integral)) < 0.01);
        p_values.push_back(fit.chi_square.p_value);
      }
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("rough dielectric: weight is value over pdf") {
  for (const RoughDielectric& bsdf : subjects()) {
    for (const Vec3 wo : kOutgoing) {
      for (const EventMask mask : {EventMask::all, kReflect, kTransmit}) {
        test::check_samples(bsdf, wo, {.events = mask});
        test::check_samples(bsdf, wo, {Transport::importance, mask});
      }
    }
  }
}

TEST_CASE("rough dielectric: one allowed event is certain") {
  const RoughDielectric bsdf = frosted(0.3f, 1.5f);
  const Vec3 wo = test::direction(40, 0), up = test::direction(50, 170),
             down = test::direction(150, 170);
  const ScatterValue both_up = bsdf.evaluate({}, wo, up, {}),
                     both_down = bsdf.evaluate({}, wo, down, {});
  const ScatterValue only_up = bsdf.evaluate({}, wo, up, {.events = kReflect}),
                     only_down = bsdf.evaluate({}, wo, down, {.events = kTransmit});
  const float fresnel = dielectric_fresnel(dot(wo, normalize(wo + up)), 1.5f).reflectance;
  CHECK(both_up.pdf == doctest::Approx(fresnel * only_up.pdf));
  CHECK(only_up.value.g == doctest::Approx(both_up.value.g));
  CHECK(only_down.pdf > both_down.pdf);
  CHECK(only_down.value.g == doctest::Approx(both_down.value.g));
  CHECK(bsdf.evaluate({}, wo, up, {.events = kTransmit}).pdf == 0);
  CHECK(bsdf.evaluate({}, wo, down, {.events = kReflect}).pdf == 0);
  for (const EventMask none : {EventMask::nothing, EventMask::discrete}) {
    CHECK_FALSE(bsdf.sample({}, wo, 0.5f, {0.3f, 0.4f}, {.events = none}));
  }
}

TEST_CASE("rough dielectric: values of both transports are adjoint") {
  RandomStream random(5);
  int compared = 0;
  for (const RoughDielectric& bsdf : subjects()) {
    for (const Vec3 wo : kOutgoing) {
      for (int i = 0; i < 50; ++i) {
        const float u_choice = random.next_1d();
        const auto s = bsdf.sample({}, wo, u_choice, random.next_2d(), {});
        if (!s) continue;
        const Vec3 wi = s->direction;
        const double there =
            double{bsdf.evaluate({}, wo, wi, {.transport = Transport::radiance}).value.g};
        const double back =
            double{bsdf.evaluate({}, wi, wo, {.transport = Transport::importance}).value.g};
        CAPTURE(wo.z);
        CAPTURE(wi.z);
        CHECK(there * std::abs(wo.z) == doctest::Approx(back * std::abs(wi.z)).epsilon(5e-3));
        ++compared;
      }
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("rough dielectric: in a white furnace only what bounces between facets is lost") {
  for (const float ior : {1.5f, 1 / 1.5f}) {
    for (const double theta : {5.0, 60.0, 85.0}) {
      CAPTURE(ior);
      CAPTURE(theta);
      const Vec3 wo = test::direction(theta, 0);
      const double smooth = total(frosted(0.05f, ior), wo), rough = total(frosted(0.5f, ior), wo);
      CHECK(smooth <= 1.0005);
      CHECK(rough <= 1.0005);
      CHECK(rough > 0.5);
      if (theta < 80) CHECK(smooth > 0.99);
      CHECK(total(frosted(0.5f, ior, Masking::separable), wo) <= 1.0005);
    }
  }
}

TEST_CASE("rough dielectric: nearly smooth it is the smooth interface") {
  for (const float ior : {1.5f, 1 / 1.5f}) {
    const RoughDielectric rough = frosted(1e-4f, ior);
    const Dielectric smooth({.ior = ior,
                             .specular_reflectance = test::uniform(Rgb(1)),
                             .specular_transmittance = test::uniform(Rgb(1))});
    for (const Transport transport : {Transport::radiance, Transport::importance}) {
      for (const double theta : {0.0, 35.0, 70.0, 100.0, 150.0}) {
        CAPTURE(ior);
        CAPTURE(theta);
        const Vec3 wo = test::direction(theta, 70);
        for (const float u_choice : {0.0f, 0.9999f}) {
          const auto expected = smooth.sample({}, wo, u_choice, {}, {.transport = transport});
          const auto s = rough.sample({}, wo, u_choice, {0.3f, 0.2f}, {.transport = transport});
          REQUIRE(s);
          REQUIRE(expected);
          CHECK(length(s->direction - expected->direction) < 2e-3f);
          CHECK(s->weight.g == doctest::Approx(expected->weight.g).epsilon(2e-3));
        }
      }
    }
  }
}

TEST_CASE("rough dielectric: no light leaves by facets of total reflection") {
  // The surface is so smooth that all facets seen at 60 degrees are beyond the critical angle of
  // 41.8.
  const RoughDielectric bsdf = frosted(0.01f, 1.5f);
  const Vec3 wo = test::direction(120, 0);
  RandomStream random(6);
  int transmitted = 0, mirrored = 0, let_through = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u = random.next_2d();
    if (const auto s = bsdf.sample({}, wo, 0.9999f, u, {})) {
      ++(s->event == Event::smooth_reflect ? mirrored : transmitted);
    }
    let_through += bsdf.sample({}, wo, 0.5f, u, {.events = kTransmit}).has_value();
  }
  // GGX has long tails, so a few facets are exceptions.
  CHECK(mirrored > 990);
  CHECK(transmitted < 5);
  CHECK(let_through < 5);
}

TEST_CASE("rough dielectric: grazing and degenerate directions give finite values") {
  const auto check = [](const RoughDielectric& bsdf) {
    for (const float z : {1e-3f, -1e-3f, 1e-6f, -1e-12f, 1e-30f, -1e-42f}) {
      const Vec3 wo{-0.6f, 0.8f, z};
      test::check_samples(bsdf, wo, {});
      for (const Vec3 wi : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0.6f, -0.8f, z}, -wo, wo,
                            Vec3{0.6f, -0.8f, 1e-5f}, Vec3{0.6f, -0.8f, 0}}) {
        const ScatterValue v = bsdf.evaluate({}, wo, wi, {});
        CHECK(is_finite(v.value));
        CHECK(std::isfinite(v.pdf));
        CHECK(v.pdf >= 0);
      }
    }
    CHECK_FALSE(bsdf.sample({}, {1, 0, 0}, 0.5f, {0.3f, 0.4f}, {}));
  };
  for (const FacetDistribution distribution :
       {FacetDistribution::ggx, FacetDistribution::beckmann}) {
    for (const float ior : {0.1f, 0.66f, 0.999f, 1.001f, 1.5f, 10.0f}) {
      for (const float alpha : {0.04f, 0.3f, 1.0f}) {
        CAPTURE(ior);
        CAPTURE(alpha);
        check(frosted(alpha, ior, Masking::height_correlated, distribution));
      }
    }
  }
}

TEST_CASE("rough dielectric: factors tint either way") {
  const Rgb mirrored{0.9f, 0.5f, 0}, refracted{0.1f, 1, 0.3f};
  const RoughDielectric plain = frosted(0.2f, 1.5f),
                        tinted({.alpha = 0.2f,
                                .ior = 1.5f,
                                .specular_reflectance = test::uniform(mirrored),
                                .specular_transmittance = test::uniform(refracted)});
  const Vec3 wo = test::direction(30, 0);
  for (const Vec3 wi : {test::direction(40, 180), test::direction(160, 180)}) {
    const ScatterValue a = plain.evaluate({}, wo, wi, {}), b = tinted.evaluate({}, wo, wi, {});
    CHECK(a.pdf == b.pdf);
    const Rgb factor = wi.z > 0 ? mirrored : refracted;
    for (int c = 0; c < 3; ++c) CHECK(b.value[c] == doctest::Approx(a.value[c] * factor[c]));
  }
  CHECK(plain.albedo({}).g == doctest::Approx(1));
  CHECK(tinted.relative_ior() == doctest::Approx(1 / 1.5));
}

TEST_CASE("rough dielectric: an index of one is no interface") {
  CHECK_THROWS_AS(frosted(1, 1), InputError);
  CHECK_THROWS_AS(frosted(0.02f, 1.001f), InputError);
  CHECK_NOTHROW(frosted(0.04f, 1.001f));
}

}  // namespace pharos

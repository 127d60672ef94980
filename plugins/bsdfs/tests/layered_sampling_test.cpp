// Properties that all materials with several lobes or nested materials must have.

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/hypothesis.h>

#include "../blend.h"
#include "../dielectric.h"
#include "../diffuse.h"
#include "../diffuse_transmitter.h"
#include "../mask.h"
#include "../plastic.h"
#include "../rough_conductor.h"
#include "../rough_plastic.h"
#include "../two_sided.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

struct Subject {
  std::string name;
  Ref<Bsdf> bsdf;
};

template <class T>
Ref<Bsdf> make(const typename T::Settings& settings) {
  return std::make_shared<T>(settings);
}

std::vector<Subject> subjects() {
  const Ref<Texture> red = test::uniform({0.9f, 0.4f, 0.1f}), blue = test::uniform({0, 0.3f, 0.8f});
  const Ref<Texture> white = test::uniform(Rgb(1)), gray = test::uniform(Rgb(0.2f));
  const Ref<Bsdf> metal = make<RoughConductor>({.alpha = 0.3f, .specular_reflectance = white});
  const Ref<Bsdf> plastic = make<Plastic>(
      {.ior = 1.7f, .reflectance = red, .specular_reflectance = white, .nonlinear = true});
  const auto rough = [&](float alpha) {
    return make<RoughPlastic>(
        {.alpha = alpha, .reflectance = blue, .specular_reflectance = white, .nonlinear = true});
  };
  const Ref<Bsdf> sheet = make<DiffuseTransmitter>({.transmittance = blue, .reflectance = gray});
  const Ref<Bsdf> both = make<TwoSided>({.bsdf = plastic, .back = rough(0.2f)});
  const Ref<Bsdf> holes = make<Mask>({.bsdf = both, .opacity = red});
  const Ref<Bsdf> glass = make<Dielectric>(
      {.ior = 1.4f, .specular_reflectance = white, .specular_transmittance = white});
  const Ref<Bsdf> frosted = make<Mask>({.bsdf = glass, .opacity = test::uniform(Rgb(0.7f))});
  const Ref<Bsdf> mixed = make<Blend>({.first = metal, .second = sheet, .weight = blue});
  const Ref<Bsdf> three_deep =
      make<Blend>({.first = make<Blend>({.first = frosted, .second = holes, .weight = red}),
                   .second = make<Blend>({.first = plastic, .second = mixed, .weight = gray}),
                   .weight = blue});
  const Ref<Bsdf> phong = test::build(
      "{ type: phong, diffuse_reflectance: [0.1, 0.2, 0.5], specular_reflectance: 0.5, exponent: "
      "300 }");
  const Ref<Bsdf> cloth = test::build(
      "{ type: principled, base_color: [0.1, 0.2, 0.4], roughness: 0.7, sheen: 1, sheen_tint: 0.5, "
      "flatness: 0.5, spec_tint: 0.3, clearcoat: 0.5, clearcoat_gloss: 0.1 }");
  const Ref<Bsdf> clear = test::build(
      "{ type: principled, base_color: [0.9, 0.6, 0.3], roughness: 0.5, spec_trans: 0.8, ior: 1.4, "
      "metallic: 0.2 }");
  const Ref<Bsdf> thinner =
      test::build("{ type: principled, base_color: 0.9, roughness: 0.7, spec_trans: 1, ior: 0.7 }");
  return {{"phong", phong},
          {"principled cloth", cloth},
          {"principled clear", clear},
          {"principled thinner", thinner},
          {"plastic", plastic},
          {"rough plastic 0.01", rough(0.01f)},
          {"rough plastic", rough(1)},
          {"diffuse transmitter", sheet},
          {"two sided", both},
          {"mask", holes},
          {"masked glass", frosted},
          {"blend", mixed},
          {"three deep", three_deep}};
}

const std::vector<Vec3> kOutgoing{test::direction(20, 200), test::direction(83, -30),
                                  test::direction(125, 100)};
const std::vector<EventMask> kMasks{EventMask::all,      EventMask::smooth,
                                    EventMask::discrete, EventMask::reflect,
                                    EventMask::transmit, mask_of(Event::pass_through)};

/// The share of light that leaves by discrete events, mean of the channels.
double discrete_albedo(const Bsdf& bsdf, Vec3 wo, ScatterOptions options) {
  double sum = 0;
  for (const DiscreteOutcome& o : bsdf.discrete({}, wo, options)) sum += mean(o.value);
  return sum;
}

}  // namespace

TEST_CASE("layered BSDFs: samples follow their density") {
  std::vector<double> p_values;
  std::uint64_t seed = 70;
  const auto fit = [&](const Subject& subject, Vec3 wo, EventMask mask) {
    if (is_empty(subject.bsdf->events() & mask & EventMask::smooth)) return;
    const auto result = test::fit_smooth(*subject.bsdf, wo, {.events = mask}, ++seed);
    INFO(subject.name << " at cosine " << wo.z << ": integral " << result.integral);
    CHECK(result.is_density());
    CHECK(result.missed == doctest::Approx(1 - result.integral).epsilon(0.02).scale(1));
    p_values.push_back(result.chi_square.p_value);
  };
  for (const Subject& subject : subjects()) {
    fit(subject, kOutgoing[0], EventMask::all);
    fit(subject, kOutgoing[1], EventMask::reflect);
    fit(subject, kOutgoing[2], EventMask::smooth);
    fit(subject, kOutgoing[2], EventMask::transmit);
  }
  CHECK(p_values.size() > 20);
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("layered BSDFs: weight is value over pdf, whatever is allowed") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const Vec3 wo : kOutgoing) {
      for (const EventMask mask : kMasks) {
        test::check_samples(*subject.bsdf, wo, {.events = mask});
        test::check_samples(*subject.bsdf, wo, {Transport::importance, mask});
      }
    }
  }
}

TEST_CASE("layered BSDFs: discrete events come as often as they say") {
  constexpr int kSamples = 20'000;
  std::vector<double> p_values;
  RandomStream random(71);
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const Vec3 wo : kOutgoing) {
      for (const EventMask mask : kMasks) {
        double sum = 0;
        std::vector<int> counts(256, 0);
        for (int i = 0; i < kSamples; ++i) {
          const float u_choice = random.next_1d();
          const auto s = subject.bsdf->sample({}, wo, u_choice, random.next_2d(), {.events = mask});
          if (s) ++counts[static_cast<std::size_t>(s->event)];
        }
        for (const DiscreteOutcome& o : subject.bsdf->discrete({}, wo, {.events = mask})) {
          const double p = o.probability;
          sum += p;
          const statistics::Estimate share{
              .mean = counts[static_cast<std::size_t>(o.event)] / double{kSamples},
              .squared_error = std::max(0.0, p * (1 - p)) / kSamples};
          p_values.push_back(statistics::one_sample_test(share, p).p_value);
        }
        CHECK(sum < 1.00001);
      }
    }
  }
  CHECK(p_values.size() > 80);
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("layered BSDFs: samples carry all the light there is, and no more than arrives") {
  constexpr int kSamples = 50'000;
  std::vector<double> p_values;
  RandomStream random(72);
  const ScatterOptions options{
      .transport = Transport::importance};  // without the factor for compressed solid angle
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const Vec3 wo : kOutgoing) {
      const double albedo = test::smooth_albedo(*subject.bsdf, wo, options) +
                            discrete_albedo(*subject.bsdf, wo, options);
      CHECK(albedo < 1.001);
      std::vector<double> weights;
      for (int i = 0; i < kSamples; ++i) {
        const float u_choice = random.next_1d();
        const auto s = subject.bsdf->sample({}, wo, u_choice, random.next_2d(), options);
        weights.push_back(s ? double{mean(s->weight)} : 0.0);
      }
      statistics::Estimate found = statistics::estimate(statistics::moments(weights));
      found.squared_error += 1e-4 * 1e-4;  // error of the quadrature
      p_values.push_back(statistics::one_sample_test(found, albedo).p_value);
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("layered BSDFs: the adjoint relation") {
  const SurfacePoint point;
  const std::vector<Vec3> directions{test::direction(20, 10), test::direction(70, 160),
                                     test::direction(110, 50), test::direction(165, 250)};
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const Vec3 a : directions) {
      for (const Vec3 b : directions) {
        const Rgb there =
            subject.bsdf->evaluate(point, a, b, {.transport = Transport::radiance}).value /
            std::abs(b.z);
        const Rgb back =
            subject.bsdf->evaluate(point, b, a, {.transport = Transport::importance}).value /
            std::abs(a.z);
        for (int c = 0; c < 3; ++c) CHECK(there[c] == doctest::Approx(back[c]).epsilon(1e-4));
      }
    }
  }
}

TEST_CASE("layered BSDFs: grazing and degenerate directions give finite values") {
  const SurfacePoint point;
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const float z : {1e-3f, 1e-6f, 1e-12f, 1e-30f, 1e-42f, 0.0f, -1e-42f, -1e-6f}) {
      const Vec3 wo{-0.6f, 0.8f, z};
      test::check_samples(*subject.bsdf, wo, {});
      for (const Vec3 wi : {Vec3{0, 0, 1}, Vec3{0.6f, -0.8f, z}, Vec3{0.6f, -0.8f, 1e-5f}, wo, -wo,
                            Vec3{0, 0, -1}}) {
        const ScatterValue v = subject.bsdf->evaluate(point, wo, wi, {});
        CHECK(is_finite(v.value));
        CHECK(std::isfinite(v.pdf));
        CHECK(v.pdf >= 0);
      }
    }
  }
}

}  // namespace pharos

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/scene/local_scattering.h>
#include <pharos/statistics/goodness_of_fit.h>

namespace pharos {
namespace {

/// A surface that is white and diffuse on both sides, mirrors light and also lets it pass straight.
class EverythingBsdf : public Bsdf {
 public:
  EventMask events() const override { return EventMask::all; }

  ScatterValue evaluate(const SurfacePoint&, Vec3 wo, Vec3 wi, ScatterOptions o) const override {
    if (!contains(o.events, Event::smooth_reflect) || wo.z * wi.z <= 0) return {};
    const float pdf = warp::cosine_hemisphere_pdf(std::abs(wi.z));
    return {Rgb(0.25f * pdf), pdf};
  }

  std::optional<ScatterSample> sample(const SurfacePoint&, Vec3 wo, float, Vec2 u,
                                      ScatterOptions o) const override {
    if (contains(o.events, Event::smooth_reflect)) {
      Vec3 wi = warp::cosine_hemisphere_from_square(u);
      wi.z = std::copysign(wi.z, wo.z);
      return ScatterSample{wi, Event::smooth_reflect, Rgb(0.25f),
                           warp::cosine_hemisphere_pdf(std::abs(wi.z))};
    }
    for (const DiscreteOutcome& d : discrete({}, wo, o)) {
      return ScatterSample{d.direction, d.event, d.value / d.probability, d.probability};
    }
    return std::nullopt;
  }

  DiscreteOutcomes discrete(const SurfacePoint&, Vec3 wo, ScatterOptions o) const override {
    DiscreteOutcomes all;
    const auto offer = [&](Event event, Vec3 direction) {
      if (contains(o.events, event)) all.add({event, direction, Rgb(0.5f), 0.5f});
    };
    offer(Event::discrete_reflect, {-wo.x, -wo.y, wo.z});
    offer(Event::pass_through, -wo);
    return all;
  }

  float roughness(const SurfacePoint&) const override { return 0.5f; }
  Rgb albedo(const SurfacePoint&) const override { return {}; }
};

class ForwardPhase : public PhaseFunction {
 public:
  float evaluate(Vec3, Vec3) const override { return 0.125f; }
  Vec3 sample(Vec3 wo, Vec2) const override { return -wo; }
  float mean_cosine() const override { return -0.75f; }
};

/// Returns a point of a surface that faces +z. Its shading normal leans towards +x.
SurfacePoint leaning(float degrees) {
  SurfacePoint p;
  p.normal = {0, 0, 1};
  p.shading = Frame::from_normal({std::sin(radians(degrees)), 0, std::cos(radians(degrees))});
  return p;
}

const EverythingBsdf bsdf;

constexpr auto kSmooth = EventMask::smooth;
constexpr auto kDiscrete = EventMask::discrete;

TEST_CASE("samples are in world space and weigh value / pdf") {
  const SurfacePoint p = leaning(30);
  const LocalScattering s(p, bsdf, normalize({0.3f, 0.4f, 0.8f}), Transport::radiance);
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto sample = s.sample(0.5f, random.next_2d(), kSmooth);
    if (!sample) continue;
    const ScatterValue value = s.evaluate(sample->direction, kSmooth);
    CHECK(value.pdf == doctest::Approx(sample->pdf).epsilon(1e-3));
    CHECK(value.value.r == doctest::Approx(sample->weight.r * sample->pdf).epsilon(1e-3));
    CHECK(value.pdf == doctest::Approx(dot(sample->direction, p.shading.n) / kPi).epsilon(1e-3));
    CHECK(s.smooth_event(sample->direction) == Event::smooth_reflect);
  }
  CHECK(s.smooth_event({0, 0, -1}) == Event::smooth_transmit);
}

TEST_CASE("the density is that of the samples, and none go where sides disagree") {
  const SurfacePoint p = leaning(50);
  const LocalScattering s(p, bsdf, normalize({0.3f, 0.4f, 0.8f}), Transport::radiance);
  const auto fit = statistics::fit_direction_density(
      [&](RandomStream& random) -> std::optional<Vec3> {
        const auto sample = s.sample(0.5f, random.next_2d(), kSmooth);
        return sample ? std::optional(sample->direction) : std::nullopt;
      },
      [&](Vec3 direction) -> double { return s.evaluate(direction, kSmooth).pdf; },
      {.draws = 40'000, .cells = 60, .quadrature_tolerance = 1e-3});
  CHECK(fit.outside_support == 0);
  CHECK(fit.missed > 0.05);  // share of the cosine lobe below the surface: (1 - cos 50) / 2
  CHECK(fit.integral + fit.missed == doctest::Approx(1).epsilon(0.01));
  CHECK(fit.chi_square.p_value > 1e-4);
  // The directions lie above the shading surface and below the geometric one, or vice versa.
  CHECK(is_black(s.evaluate(normalize({0.9f, 0, -0.1f})).value));
  CHECK(s.evaluate(normalize({0.9f, 0, -0.1f})).pdf == 0);
  CHECK(s.evaluate(normalize({-0.9f, 0, 0.1f})).pdf == 0);
}

TEST_CASE("seen from where sides disagree, only straight ways stay open") {
  const SurfacePoint p = leaning(60);
  const Vec3 wo = normalize({-0.9f, 0, 0.1f});  // above the geometric, below the shading surface
  const LocalScattering s(p, bsdf, wo, Transport::radiance);
  CHECK(is_black(s.evaluate({0, 0, 1}).value));
  CHECK(is_black(s.evaluate({0, 0, -1}).value));
  CHECK_FALSE(s.sample(0.5f, {0.3f, 0.3f}, kSmooth));
  const DiscreteOutcomes outcomes = s.discrete();
  REQUIRE(outcomes.count == 1);
  CHECK(outcomes.outcomes[0].event == Event::pass_through);
  CHECK(length(outcomes.outcomes[0].direction + wo) < 1e-6f);
  const auto through = s.sample(0.5f, {}, mask_of(Event::pass_through));
  REQUIRE(through);
  CHECK(through->weight == Rgb(1));
}

TEST_CASE("discrete outcomes are in world space") {
  const SurfacePoint p = leaning(20);
  const Vec3 wo = normalize({0.1f, 0.2f, 1});
  const LocalScattering s(p, bsdf, wo, Transport::radiance);
  REQUIRE(s.discrete().count == 2);
  const DiscreteOutcome mirrored = s.discrete(mask_of(Event::discrete_reflect)).outcomes[0];
  const Vec3 expected = 2 * dot(wo, p.shading.n) * p.shading.n - wo;
  CHECK(length(mirrored.direction - expected) < 1e-6f);
  CHECK(mirrored.value == Rgb(0.5f));
  const auto sample = s.sample(0, {}, kDiscrete);
  REQUIRE(sample);
  CHECK(sample->event == Event::discrete_reflect);
  CHECK(length(sample->direction - expected) < 1e-6f);
  CHECK(sample->weight == Rgb(1));
  CHECK(s.discrete(kSmooth).count == 0);
}

TEST_CASE("importance is the adjoint of radiance over geometric cosines") {
  const SurfacePoint p = leaning(35);
  RandomStream random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = warp::cosine_hemisphere_from_square(random.next_2d());
    const Vec3 b = warp::cosine_hemisphere_from_square(random.next_2d());
    if (a.z < 0.01f || b.z < 0.01f) continue;
    const LocalScattering from_sensor(p, bsdf, a, Transport::radiance);
    const LocalScattering from_light(p, bsdf, b, Transport::importance);
    const float radiance = from_sensor.evaluate(b).value.r / b.z;
    const float importance = from_light.evaluate(a).value.r / a.z;
    CHECK(importance == doctest::Approx(radiance).epsilon(1e-3));
  }
}

TEST_CASE("importance's correction is in samples and discrete outcomes too") {
  const SurfacePoint p = leaning(35);
  const Vec3 wo = normalize({0.2f, 0.5f, 0.7f});
  const LocalScattering s(p, bsdf, wo, Transport::importance);
  const LocalScattering plain(p, bsdf, wo, Transport::radiance);
  const auto sample = s.sample(0.5f, {0.4f, 0.3f}, kSmooth);
  REQUIRE(sample);
  CHECK(sample->weight.r * sample->pdf ==
        doctest::Approx(s.evaluate(sample->direction, kSmooth).value.r).epsilon(1e-3));
  const DiscreteOutcome mirrored = s.discrete().outcomes[0];
  const float cosines = std::abs(dot(wo, p.shading.n) * mirrored.direction.z) /
                        std::abs(wo.z * dot(mirrored.direction, p.shading.n));
  CHECK(mirrored.value.r == doctest::Approx(0.5f * cosines).epsilon(1e-3));
  CHECK(plain.discrete().outcomes[0].value.r == 0.5f);
  CHECK(s.discrete().outcomes[1].value.r == 0.5f);  // straight through
}

TEST_CASE("media scatter by their phase function") {
  const ForwardPhase phase;
  const Vec3 wo{0, 0, 1};
  const LocalScattering s(phase, {1, 2, 4}, wo, Transport::radiance);
  CHECK_FALSE(s.is_surface());
  CHECK(s.events() == mask_of(Event::scatter));
  CHECK_FALSE(s.purely_discrete());
  CHECK(s.roughness() == 0.25f);
  CHECK(s.evaluate({1, 0, 0}).pdf == 0.125f);
  CHECK(s.evaluate({1, 0, 0}).value == 0.125f * Rgb(1, 2, 4));
  const auto sample = s.sample(0, {});
  REQUIRE(sample);
  CHECK(sample->event == Event::scatter);
  CHECK(sample->direction == -wo);
  CHECK(sample->weight == Rgb(1, 2, 4));
  CHECK(sample->pdf == 0.125f);
  CHECK(s.smooth_event({1, 0, 0}) == Event::scatter);
  CHECK(s.discrete().count == 0);
  CHECK_FALSE(s.sample(0, {}, EventMask::reflect));
  CHECK(s.evaluate({1, 0, 0}, EventMask::reflect).pdf == 0);
}

}  // namespace
}  // namespace pharos

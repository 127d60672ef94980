#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

/// A configuration in which a BSDF is queried.
struct Question {
  SurfacePoint point;
  Vec3 wo;
  ScatterOptions options;

  std::string text() const {
    return fmt::format("wo ({:.6g}, {:.6g}, {:.6g}), events {}, {}", wo.x, wo.y, wo.z,
                       static_cast<int>(options.events),
                       options.transport == Transport::radiance ? "radiance" : "importance");
  }
};

Vec3 direction(float theta, float phi) {
  const float s = std::sin(radians(theta));
  return {s * std::cos(radians(phi)), s * std::sin(radians(phi)), std::cos(radians(theta))};
}

std::string text(Vec3 v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

/// A point whose texture coordinates run along x and y, one unit of them per unit of length.
SurfacePoint point_at(Vec2 uv) {
  return {.uv = uv, .tangents = {{1, 0, 0}, {0, 1, 0}}};
}

std::vector<Vec3> outgoing_directions() {
  return {direction(0, 0),    direction(35, 70),  direction(65, 200),
          direction(85, 320), direction(140, 20), direction(100, 260)};
}

/// Returns every outgoing direction with all events in both transports, and with the events of each
/// side in radiance transport.
std::vector<Question> questions() {
  std::vector<Question> all;
  for (const Vec3 wo : outgoing_directions()) {
    const auto i = static_cast<float>(all.size());
    const SurfacePoint point = point_at({std::fmod(0.31f + 0.037f * i, 1.0f), 0.72f - 0.02f * i});
    all.push_back({point, wo, {Transport::radiance, EventMask::all}});
    all.push_back({point, wo, {Transport::importance, EventMask::all}});
    all.push_back({point, wo, {Transport::radiance, EventMask::reflect}});
    all.push_back({point, wo, {Transport::radiance, EventMask::transmit}});
  }
  return all;
}

std::optional<ScatterSample> draw(const Bsdf& bsdf, const Question& q, RandomStream& random) {
  const float u_choice = random.next_1d();
  return bsdf.sample(q.point, q.wo, u_choice, random.next_2d(), q.options);
}

ScatterValue evaluate(const Bsdf& bsdf, const Question& q, Vec3 wi) {
  return bsdf.evaluate(q.point, q.wo, wi, q.options);
}

/// Returns the listed outcome of a sample; null if there is none.
const DiscreteOutcome* outcome_of(const DiscreteOutcomes& outcomes, const ScatterSample& s) {
  for (const DiscreteOutcome& o : outcomes) {
    if (o.event == s.event) return &o;
  }
  return nullptr;
}

void check_density(const Bsdf& bsdf, Suite& suite) {
  Check& chi_square = suite.check("chi_square");
  Check& integral = suite.check("integral");
  if (is_empty(bsdf.events() & EventMask::smooth)) {
    chi_square.not_applicable("no smooth events");
    integral.not_applicable("no smooth events");
    return;
  }
  for (const Question& q : questions()) {
    const auto draw_smooth = [&](RandomStream& random) -> std::optional<Vec3> {
      const auto s = draw(bsdf, q, random);
      return s && !is_discrete(s->event) ? std::optional(s->direction) : std::nullopt;
    };
    const auto density = [&](Vec3 wi) { return double{evaluate(bsdf, q, wi).pdf}; };
    test_directions({draw_smooth, density, q.text()}, suite.seed(), chi_square, integral);
  }
}

void check_sample_weight(const Bsdf& bsdf, const Question& q, const ScatterSample& s,
                         Check& check) {
  constexpr double kTolerance = 0.01;
  const auto fault = [&](const char* what, Rgb expected, float pdf) {
    return fmt::format(
        "{}, wi {}: {}: weight ({:.6g}, {:.6g}, {:.6g}) and pdf {:.6g}, expected "
        "({:.6g}, {:.6g}, {:.6g}) and {:.6g}",
        q.text(), text(s.direction), what, s.weight.r, s.weight.g, s.weight.b, s.pdf, expected.r,
        expected.g, expected.b, pdf);
  };
  if (is_discrete(s.event)) {
    const DiscreteOutcomes outcomes = bsdf.discrete(q.point, q.wo, q.options);
    const DiscreteOutcome* o = outcome_of(outcomes, s);
    check.expect(o != nullptr, [&] { return q.text() + ": a discrete sample is not listed"; });
    if (o == nullptr) return;
    const Rgb expected = o->value / o->probability;
    check.expect(close(s.weight, expected, kTolerance) &&
                     close(s.pdf, o->probability, kTolerance) &&
                     length(s.direction - o->direction) < 1e-3f,
                 [&] { return fault("listed outcome", expected, o->probability); });
  } else {
    const ScatterValue v = evaluate(bsdf, q, s.direction);
    const Rgb expected = v.value / v.pdf;
    check.expect_mostly(close(s.weight, expected, kTolerance) && close(s.pdf, v.pdf, kTolerance),
                        [&] { return fault("evaluate()", expected, v.pdf); });
  }
}

void check_weight(const Bsdf& bsdf, Suite& suite) {
  Check& check = suite.check("weight");
  check.not_applicable("nothing is ever sampled");
  for (const Question& q : questions()) {
    RandomStream random(suite.seed(), 1);
    for (int i = 0; i < 500; ++i) {
      if (const auto s = draw(bsdf, q, random)) check_sample_weight(bsdf, q, *s, check);
    }
  }
}

/// f of radiance must be f of importance with the directions exchanged.
void check_adjoint_pair(const Bsdf& bsdf, const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        Check& check) {
  const Rgb forth = bsdf.evaluate(point, wo, wi, {Transport::radiance}).value / std::abs(wi.z);
  const Rgb back = bsdf.evaluate(point, wi, wo, {Transport::importance}).value / std::abs(wo.z);
  check.expect_mostly(close(forth, back, 0.01, 1e-6), [&] {
    return fmt::format("wo {}, wi {}: f of radiance {:.6g}, of importance {:.6g}", text(wo),
                       text(wi), max_component(forth), max_component(back));
  });
}

/// Light that goes one way through an interface also comes back. For outcomes of value v,
/// v cos(o) dw_o of radiance transport equals v cos(i) dw_i of importance transport. By Snell's
/// law, n^2 cos dw is the same on both sides (Veach 1997, sec. 5.2). The values thus differ by (sin
/// i / sin o)^2.
void check_adjoint_outcomes(const Bsdf& bsdf, const SurfacePoint& point, Vec3 wo, Check& check) {
  for (const DiscreteOutcome& o : bsdf.discrete(point, wo, {Transport::radiance})) {
    const double sine_o = std::hypot(wo.x, wo.y), sine_i = std::hypot(o.direction.x, o.direction.y);
    if (sine_o < 0.05 || sine_i < 0.05) continue;
    Rgb back;
    for (const DiscreteOutcome& b : bsdf.discrete(point, o.direction, {Transport::importance})) {
      if (b.event == o.event && length(b.direction - wo) < 1e-2f) back = b.value;
    }
    const Rgb expected = static_cast<float>(square(sine_i / sine_o)) * back;
    check.expect(close(o.value, expected, 0.01, 1e-6), [&] {
      return fmt::format(
          "wo {}: a discrete outcome towards {} has the share {:.6g}, expected {:.6g} "
          "from importance going back",
          text(wo), text(o.direction), max_component(o.value), max_component(expected));
    });
  }
}

void check_adjoint(const Bsdf& bsdf, Suite& suite) {
  Check& check = suite.check("adjoint");
  check.not_applicable("nothing is scattered");
  RandomStream random(suite.seed(), 2);
  for (int i = 0; i < 2000; ++i) {
    const SurfacePoint point = point_at(random.next_2d());
    const Vec3 wo = warp::sphere_from_square(random.next_2d());
    Vec3 wi = warp::sphere_from_square(random.next_2d());
    if (i % 2 == 0) {
      const auto s = draw(bsdf, {point, wo, {}}, random);
      if (!s || is_discrete(s->event)) continue;
      wi = s->direction;
    }
    if (std::abs(wo.z) < 0.05f || std::abs(wi.z) < 0.05f) continue;
    check_adjoint_pair(bsdf, point, wo, wi, check);
  }
  if (bsdf.tilts_normal()) return;  // Snell's law holds for a normal that only the BSDF knows
  for (const Vec3 wo : outgoing_directions()) check_adjoint_outcomes(bsdf, {}, wo, check);
}

/// Returns the transport in which energy is tested. Importance transport carries light without the
/// factor 1/eta^2 of radiance. With a tilted normal, importance may increase
/// (Veach 1997, sec. 5.3), but radiance must not.
Transport energy_transport(const Bsdf& bsdf) {
  return bsdf.tilts_normal() ? Transport::radiance : Transport::importance;
}

/// Returns the factor that removes 1/eta^2 from a sample's weight.
float energy_factor(const Bsdf& bsdf, const Question& q, const ScatterSample& s) {
  const bool refracted = contains(EventMask::transmit, s.event) && s.event != Event::pass_through;
  if (q.options.transport == Transport::importance || !refracted) return 1;
  const float eta = q.wo.z > 0 ? 1 / bsdf.relative_ior() : bsdf.relative_ior();
  return eta * eta;
}

void check_energy(const Bsdf& bsdf, Suite& suite) {
  constexpr double kTolerance = 0.005;
  Check& check = suite.check("energy");
  for (const Vec3 wo : outgoing_directions()) {
    const Question q{point_at({0.4f, 0.6f}), wo, {energy_transport(bsdf)}};
    RandomStream random(suite.seed(), 3);
    std::array<std::vector<double>, 3> weights;
    for (int i = 0; i < 10'000; ++i) {
      const auto s = draw(bsdf, q, random);
      for (int c = 0; c < 3; ++c) {
        weights[static_cast<std::size_t>(c)].push_back(
            s ? double{energy_factor(bsdf, q, *s) * s->weight[c]} : 0);
      }
    }
    for (const std::vector<double>& channel : weights) {
      const statistics::Estimate albedo = statistics::estimate(statistics::moments(channel));
      const bool plausible = albedo.mean <= 1 + kTolerance;
      check.add_p_value(plausible ? 1 : statistics::one_sample_test(albedo, 1 + kTolerance).p_value,
                        fmt::format("{}: {:.4f} of the light is scattered", q.text(), albedo.mean));
    }
  }
}

/// Expects that a sample or outcome is a single event that was asked for, on its side.
void expect_event(const Bsdf& bsdf, const Question& q, Event event, Vec3 wi, Check& check) {
  const bool one = std::has_single_bit(static_cast<std::uint8_t>(event));
  check.expect(one && contains(bsdf.events() & q.options.events, event), [&] {
    return fmt::format("{}: the event {} is not among those declared and asked for", q.text(),
                       static_cast<int>(event));
  });
  const bool same_side = q.wo.z * wi.z > 0;
  const bool right_side = event == Event::pass_through
                              ? length(wi + q.wo) < 1e-4f
                              : contains(EventMask::reflect, event) == same_side;
  check.expect(right_side, [&] {
    return fmt::format("{}: the event {} leads to {}", q.text(), static_cast<int>(event), text(wi));
  });
}

void check_masked_value(const Bsdf& bsdf, const Question& q, Vec3 wi, Check& check) {
  const Event event = q.wo.z * wi.z > 0 ? Event::smooth_reflect : Event::smooth_transmit;
  const ScatterValue masked = evaluate(bsdf, q, wi);
  if (!contains(q.options.events & bsdf.events(), event)) {
    check.expect(is_black(masked.value) && masked.pdf == 0, [&] {
      return q.text() + ", wi " + text(wi) +
             ": value or density of an event not declared or asked for";
    });
    return;
  }
  const ScatterValue all = bsdf.evaluate(q.point, q.wo, wi, {q.options.transport});
  check.expect(close(masked.value, all.value, 1e-4), [&] {
    return q.text() + ", wi " + text(wi) + ": the value depends on what else is asked for";
  });
}

void check_events(const Bsdf& bsdf, Suite& suite) {
  Check& check = suite.check("events");
  RandomStream random(suite.seed(), 4);
  for (Question q : questions()) {
    for (const EventMask mask : {q.options.events, EventMask::smooth, EventMask::discrete,
                                 EventMask::smooth & EventMask::reflect, EventMask::nothing}) {
      q.options.events = mask;
      for (const DiscreteOutcome& o : bsdf.discrete(q.point, q.wo, q.options)) {
        expect_event(bsdf, q, o.event, o.direction, check);
      }
      for (int i = 0; i < 100; ++i) {
        if (const auto s = draw(bsdf, q, random)) {
          expect_event(bsdf, q, s->event, s->direction, check);
        }
        check_masked_value(bsdf, q, warp::sphere_from_square(random.next_2d()), check);
      }
    }
  }
}

/// Directions of all elevations, down to denormal and zero cosines.
std::vector<Vec3> extreme_directions() {
  std::vector<Vec3> all;
  for (const float z : {1.0f, 0.7f, 1e-2f, 1e-4f, 1e-6f, 1e-12f, 1e-20f, 1e-38f, 1e-42f, 0.0f}) {
    const float s = safe_sqrt((1 - z) * (1 + z));
    for (const float sign : {1.0f, -1.0f}) {
      all.push_back({s, 0, sign * z});
      all.push_back({-0.6f * s, 0.8f * s, sign * z});
    }
  }
  return all;
}

void expect_finite(const Question& q, const ScatterSample& s, Check& check) {
  check.expect(is_finite(s.direction) && std::abs(length(s.direction) - 1) < 1e-3f &&
                   is_non_negative(s.weight) && is_non_negative(s.pdf),
               [&] {
                 return fmt::format("{}: sample towards {} of weight ({}, {}, {}) and pdf {}",
                                    q.text(), text(s.direction), s.weight.r, s.weight.g, s.weight.b,
                                    s.pdf);
               });
}

void check_finite_from(const Bsdf& bsdf, const Question& q, Check& check) {
  for (const Vec3 wi : extreme_directions()) {
    const ScatterValue v = evaluate(bsdf, q, wi);
    check.expect(is_non_negative(v.value) && is_non_negative(v.pdf), [&] {
      return fmt::format("{}, wi {}: value ({}, {}, {}) and pdf {}", q.text(), text(wi), v.value.r,
                         v.value.g, v.value.b, v.pdf);
    });
  }
  for (const DiscreteOutcome& o : bsdf.discrete(q.point, q.wo, q.options)) {
    expect_finite(q, {o.direction, o.event, o.value, o.probability}, check);
  }
  for (const float choice : {0.0f, 0.5f, kOneMinusEpsilon}) {
    for (const float x : {0.0f, 0.25f, 0.5f, kOneMinusEpsilon}) {
      for (const float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
        const auto s = bsdf.sample(q.point, q.wo, choice, {x, y}, q.options);
        if (s) expect_finite(q, *s, check);
      }
    }
  }
}

void check_finite(const Bsdf& bsdf, Suite& suite) {
  Check& check = suite.check("finite");
  for (const Vec3 wo : extreme_directions()) {
    for (const Transport transport : {Transport::radiance, Transport::importance}) {
      check_finite_from(bsdf, {point_at({}), wo, {transport}}, check);
    }
  }
  const float roughness = bsdf.roughness({});
  check.expect(roughness >= 0 && roughness <= 1,
               [&] { return fmt::format("roughness() is {}", roughness); });
  check.expect(is_non_negative(bsdf.albedo({})) && bsdf.relative_ior() > 0,
               [] { return "albedo() or relative_ior() is negative or not finite"; });
}

/// Tests the frequencies of each outcome, of all smooth events together and of no event.
void test_outcomes(const Bsdf& bsdf, const Question& q, std::uint64_t seed, Check& check) {
  constexpr int kDraws = 20'000;
  const DiscreteOutcomes outcomes = bsdf.discrete(q.point, q.wo, q.options);
  double sum = 0;
  std::vector<double> expected, observed(static_cast<std::size_t>(outcomes.count) + 1, 0.0);
  for (const DiscreteOutcome& o : outcomes) {
    sum += o.probability;
    expected.push_back(kDraws * double{o.probability});
  }
  check.expect(sum <= 1 + 1e-5,
               [&] { return fmt::format("{}: probabilities add up to {}", q.text(), sum); });
  RandomStream random(seed, 5);
  for (int i = 0; i < kDraws; ++i) {
    const auto s = draw(bsdf, q, random);
    const DiscreteOutcome* o = s ? outcome_of(outcomes, *s) : nullptr;
    ++observed[static_cast<std::size_t>(o != nullptr ? o - outcomes.begin() : outcomes.count)];
  }
  const double rest = kDraws * std::max(0.0, 1 - sum);
  // An outcome that is certain or impossible has no variance for a statistic.
  check.expect(rest > 0.5 || observed.back() < 5,
               [&] { return q.text() + ": samples other than the listed outcomes"; });
  expected.push_back(rest);
  const auto test = statistics::chi_square_test(observed, expected);
  check.add_p_value(test.p_value, fmt::format("{}: frequencies of outcomes", q.text()));
}

void check_discrete(const Bsdf& bsdf, Suite& suite) {
  Check& check = suite.check("discrete");
  const bool none = is_empty(bsdf.events() & EventMask::discrete);
  if (none) check.not_applicable("no discrete events");
  for (const Question& q : questions()) {
    if (!none) {
      test_outcomes(bsdf, q, suite.seed(), check);
    } else if (bsdf.discrete(q.point, q.wo, q.options).count > 0) {
      check.expect(false, [] { return "discrete events that are not declared"; });
    }
  }
}

void check_determinism(const Bsdf& bsdf, Suite& suite) {
  Check& check = suite.check("determinism");
  for (const Question& q : questions()) {
    RandomStream random(suite.seed(), 6);
    for (int i = 0; i < 20; ++i) {
      RandomStream again = random;
      const auto a = draw(bsdf, q, random);
      const auto b = draw(bsdf, q, again);
      const bool same = a.has_value() == b.has_value() &&
                        (!a || (a->direction == b->direction && a->weight == b->weight &&
                                a->pdf == b->pdf && a->event == b->event));
      check.expect(same, [&] { return q.text() + ": the same numbers give another sample"; });
      const Vec3 wi = a ? a->direction : Vec3{0, 0, 1};
      const ScatterValue v = evaluate(bsdf, q, wi), w = evaluate(bsdf, q, wi);
      check.expect(v.value == w.value && v.pdf == w.pdf,
                   [&] { return q.text() + ": evaluate() changes its mind"; });
    }
  }
}

}  // namespace

void check_bsdf(const Bsdf& bsdf, Suite& suite) {
  check_density(bsdf, suite);
  check_weight(bsdf, suite);
  check_adjoint(bsdf, suite);
  check_energy(bsdf, suite);
  check_events(bsdf, suite);
  check_finite(bsdf, suite);
  check_discrete(bsdf, suite);
  check_determinism(bsdf, suite);
}

}  // namespace pharos::conformance

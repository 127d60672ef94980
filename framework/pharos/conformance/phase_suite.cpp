#include <fmt/format.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/warp.h>

namespace pharos::conformance {
namespace {

constexpr int kPairs = 2000;

std::string text(Vec3 wo, Vec3 wi) {
  return fmt::format("from ({:.4g}, {:.4g}, {:.4g}) into ({:.4g}, {:.4g}, {:.4g})", wo.x, wo.y,
                     wo.z, wi.x, wi.y, wi.z);
}

void check_density(const PhaseFunction& phase, Suite& suite) {
  Check &chi_square = suite.check("chi_square"), &integral = suite.check("integral");
  for (const Vec3 wo : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, normalize(Vec3{1, -2, 0.5f})}) {
    const auto draw = [&](RandomStream& random) {
      return std::optional(phase.sample(wo, random.next_2d()));
    };
    const auto density = [&](Vec3 wi) { return double{phase.evaluate(wo, wi)}; };
    test_directions({draw, density, fmt::format("from ({:.3g}, {:.3g}, {:.3g})", wo.x, wo.y, wo.z)},
                    suite.seed(), chi_square, integral);
  }
}

/// Light can be followed either way, and reversing a path exchanges the directions.
void check_reciprocity(const PhaseFunction& phase, Suite& suite) {
  Check& check = suite.check("reciprocity");
  RandomStream random(suite.seed(), 1);
  for (int i = 0; i < kPairs; ++i) {
    const Vec3 wo = warp::sphere_from_square(random.next_2d());
    const Vec3 wi = warp::sphere_from_square(random.next_2d());
    check.expect(close(phase.evaluate(wo, wi), phase.evaluate(wi, wo), 1e-3),
                 [&] { return text(wo, wi) + ": another value when exchanged"; });
  }
}

void check_mean_cosine(const PhaseFunction& phase, Suite& suite) {
  constexpr int kDraws = 100'000;
  const Vec3 wo = normalize(Vec3{0.3f, 0.5f, -1});
  RandomStream random(suite.seed(), 2);
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) sum -= dot(wo, phase.sample(wo, random.next_2d()));
  const double found = sum / kDraws, claimed = phase.mean_cosine();
  Check& check = suite.check("mean_cosine");
  check.expect(std::abs(claimed) < 1, [&] { return fmt::format("mean_cosine() is {}", claimed); });
  check.expect(std::abs(found - claimed) <= 0.01, [&] {
    return fmt::format("mean_cosine() is {:.5g}, that of draws {:.5g}", claimed, found);
  });
}

void check_finite(const PhaseFunction& phase, Suite& suite) {
  Check& check = suite.check("finite");
  const Vec3 wo = normalize(Vec3{0.3f, 0.5f, -1});
  for (const float u : {0.0f, 1e-30f, 1e-7f, 0.5f, 0.99999994f}) {
    for (const float v : {0.0f, 0.25f, 0.99999994f}) {
      const Vec3 wi = phase.sample(wo, {u, v});
      check.expect(std::abs(length(wi) - 1) < 1e-4f,
                   [&] { return fmt::format("the draw of ({}, {}) is not unit", u, v); });
    }
  }
  for (const Vec3 wi : {wo, -wo}) {
    check.expect(is_non_negative(phase.evaluate(wo, wi)),
                 [&] { return text(wo, wi) + " has a value that is negative or not finite"; });
  }
}

}  // namespace

void check_phase_function(const PhaseFunction& phase, Suite& suite) {
  check_density(phase, suite);
  check_reciprocity(phase, suite);
  check_mean_cosine(phase, suite);
  check_finite(phase, suite);
}

}  // namespace pharos::conformance

#include "../step_cost.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

namespace pharos {
namespace {

/// Returns steps of three techniques with random densities and weights.
std::vector<FoundStep> random_steps(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<FoundStep> steps(count);
  for (FoundStep& step : steps) {
    step.weight = std::exp(4 * random.next_1d());
    for (std::size_t i = 0; i < 3; ++i) step.ratios[i] = std::exp(6 * random.next_1d() - 4);
  }
  return steps;
}

}  // namespace

TEST_CASE("step cost: the best shares are those that a search over all shares finds") {
  for (const auto objective : {MixingObjective::variance, MixingObjective::kl}) {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      CAPTURE(seed);
      const std::vector<FoundStep> steps = random_steps(40, seed);
      double least = 1e300;
      for (int i = 0; i <= 200; ++i) {
        for (int j = 0; i + j <= 200; ++j) {
          const Simplex shares{i / 200.0, j / 200.0, (200 - i - j) / 200.0};
          least = std::min(least, cost_of(steps, shares, 3, objective));
        }
      }
      const Simplex best = least_cost(steps, {true, true, true}, 3, objective);
      CHECK(best[0] + best[1] + best[2] == doctest::Approx(1));
      CHECK(cost_of(steps, best, 3, objective) < least * (1 + 1e-4));
      const Simplex two = least_cost(steps, {true, false, true}, 3, objective);
      CHECK(two[1] == 0);
      CHECK(cost_of(steps, two, 3, objective) >= cost_of(steps, best, 3, objective) * (1 - 1e-9));
    }
  }
}

TEST_CASE("step cost: in closed form") {
  const std::vector<FoundStep> steps{{1, {0.5f, 2, 0}}, {3, {1, 0.25f, 0}}};
  const Simplex half{0.5, 0.5, 0};
  CHECK(cost_of(steps, half, 3, MixingObjective::variance) ==
        doctest::Approx((1 / 1.25 + 3 / 0.625) / 4));
  CHECK(cost_of(steps, half, 3, MixingObjective::kl) ==
        doctest::Approx(std::exp(-(std::log(1.25) + 3 * std::log(0.625)) / 4)));
}

TEST_CASE("step cost: a technique that cannot draw a step does not help it") {
  const std::vector<FoundStep> steps{{1, {0, 2, 0}}, {1, {0, 1, 0}}};
  for (const auto objective : {MixingObjective::variance, MixingObjective::kl}) {
    const Simplex best = least_cost(steps, {true, true, true}, 3, objective);
    CHECK(best[1] == doctest::Approx(1));
    CHECK(std::isinf(cost_of(steps, {1, 0, 0}, 3, objective)));
    const Simplex bounded = with_least_unguided(best, 0.2, 3);
    CHECK(bounded[0] == 0.2);
    CHECK(bounded[1] == doctest::Approx(0.8));
  }
}

TEST_CASE("step cost: the number of techniques makes no difference, nor does their order") {
  const std::vector<FoundStep> steps = random_steps(40, 1);
  for (const auto objective : {MixingObjective::variance, MixingObjective::kl}) {
    const Simplex three = least_cost(steps, {true, true, true}, 3, objective);
    REQUIRE(three[2] > 0);
    for (std::size_t count = 4; count <= kMostTechniques; ++count) {
      CAPTURE(count);
      std::vector<FoundStep> moved = steps;
      for (FoundStep& step : moved) std::swap(step.ratios[2], step.ratios[count - 1]);
      TechniqueSet allowed{true, true};
      allowed[count - 1] = true;
      Simplex expected = three;
      std::swap(expected[2], expected[count - 1]);
      CHECK(least_cost(moved, allowed, count, objective) == expected);
    }
    const Simplex two = least_cost(steps, {true, false, true}, 3, objective);
    std::vector<FoundStep> moved = steps;
    for (FoundStep& step : moved) std::swap(step.ratios[1], step.ratios[2]);
    CHECK(least_cost(moved, {true, true}, 2, objective) == Simplex{two[0], two[2]});
  }
}

}  // namespace pharos

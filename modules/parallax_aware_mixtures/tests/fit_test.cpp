#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "../vmf_fit.h"
#include "test_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

using namespace testing;

std::vector<WeightedDirection> draws_of(const Mixture& mixture, int count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<WeightedDirection> all;
  for (int i = 0; i < count; ++i) {
    all.push_back({draw_from(mixture, random), 0.5f + random.next_1d()});
  }
  return all;
}

double weight_of(const std::vector<WeightedDirection>& directions) {
  double sum = 0;
  for (const WeightedDirection& d : directions) sum += d.weight;
  return sum;
}

/// Returns random frozen moments for `count` lobes, each with a weight below 100.
std::vector<Moments> any_moments(std::size_t count, RandomStream& random) {
  std::vector<Moments> all(count);
  for (Moments& m : all) {
    m.weight = 100 * random.next_1d();
    m.resultant = 0.9 * m.weight * to_direction(any_direction(random));
  }
  return all;
}

TEST_CASE("steps never lower the objective, with what was seen before and masked or not") {
  RandomStream random(1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Mixture truth = any_mixture(3, 2, 2000, random);
    const auto directions = draws_of(truth, 2000, 10 + static_cast<std::uint64_t>(repeat));
    Mixture mixture = any_mixture(6, 1, 50, random);
    const std::vector<Moments> frozen =
        repeat % 2 == 0 ? std::vector<Moments>{} : any_moments(6, random);
    const std::vector<std::size_t> changing =
        repeat % 3 == 0 ? std::vector<std::size_t>{1, 3, 4} : std::vector<std::size_t>{};
    const FitRules rules{.frozen = frozen, .changing = changing};
    double seen = weight_of(directions), last = -1e300;
    for (const Moments& m : frozen) seen += m.weight;
    for (int step = 0; step < 30; ++step) {
      const Expectation now = expectation(mixture, directions);
      const double reached = objective(mixture, now.log_likelihood, seen, rules);
      // Sums are in single precision: the tolerance is 1e-6 times the number of directions.
      CHECK(reached > last - 2e-3);
      last = reached;
      std::vector<Moments> moments = now.moments;
      for (std::size_t k = 0; k < frozen.size(); ++k) moments[k] += frozen[k];
      maximize(moments, rules, mixture);
    }
  }
}

TEST_CASE("the E step is the one of a direct computation, for any number of directions") {
  RandomStream random(6);
  const Mixture mixture = any_mixture(11, 1, 500, random);
  for (const int count : {1, 7, 8, 13, 300}) {
    CAPTURE(count);
    const auto directions = draws_of(mixture, count, 7);
    double log_likelihood = 0;
    std::vector<double> weights(mixture.size());
    for (const WeightedDirection& d : directions) {
      std::vector<double> terms;
      double total = 0;
      for (const Lobe& lobe : mixture) {
        const double versine = 1 - lobe.mean.dot(to_direction(d.direction));
        terms.push_back(lobe.weight * von_mises_fisher::mode_density(lobe.kappa) *
                        std::exp(-lobe.kappa * versine));
        total += terms.back();
      }
      log_likelihood += d.weight * std::log(total);
      for (std::size_t k = 0; k < terms.size(); ++k) weights[k] += d.weight * terms[k] / total;
    }
    const Expectation now = expectation(mixture, directions);
    CHECK(std::abs(now.log_likelihood - log_likelihood) < 1e-4 * count);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      CHECK(std::abs(now.moments[k].weight - weights[k]) < 1e-4 * count);
    }
  }
}

TEST_CASE("a fit recovers the mixture that directions were drawn from") {
  const Mixture truth{{0.5, Direction(0, 0, 1), 20},
                      {0.3, Direction(1, 0, 0), 400},
                      {0.2, Direction(0, -0.6, -0.8), 3}};
  Mixture mixture{{0.4, Direction(0, 0.6, 0.8), 5},
                  {0.3, Direction(0.8, 0.6, 0), 5},
                  {0.3, Direction(0, -1, 0), 5}};
  fit(mixture, draws_of(truth, 60'000, 3), {.prior_share = 1e-6, .tolerance = 1e-6});
  for (std::size_t k = 0; k < truth.size(); ++k) {
    CAPTURE(k);
    CHECK(mixture[k].weight == doctest::Approx(truth[k].weight).epsilon(0.03));
    CHECK(mixture[k].mean.dot(truth[k].mean) > 0.998);
    CHECK(mixture[k].kappa == doctest::Approx(truth[k].kappa).epsilon(0.05));
  }
}

TEST_CASE("weights add up to one, and lobes that do not change keep theirs") {
  RandomStream random(4);
  const auto directions = draws_of(any_mixture(3, 2, 200, random), 3000, 5);
  Mixture mixture = any_mixture(5, 1, 50, random);
  const Mixture before = mixture;
  const std::size_t changing[] = {0, 2};
  fit(mixture, directions, {.changing = changing});
  double sum = 0;
  for (const Lobe& lobe : mixture) sum += lobe.weight;
  CHECK(sum == doctest::Approx(1));
  for (const std::size_t k : {1u, 3u, 4u}) {
    CHECK(mixture[k].weight == before[k].weight);
    CHECK(mixture[k].mean == before[k].mean);
  }
  CHECK(mixture[0].mean != before[0].mean);
}

TEST_CASE("directions far from all lobes count, and concentrations stay below their limit") {
  const std::vector<WeightedDirection> one_place(100, {Vec3{0, 0, -1}, 1});
  Mixture mixture{{1, Direction(0, 0, 1), 30'000}};
  const Expectation now = expectation(mixture, one_place);
  CHECK(now.moments[0].weight == doctest::Approx(100));
  CHECK(std::isfinite(now.log_likelihood));
  fit(mixture, one_place, {.prior_strength = 1e-6, .most_kappa = 500});
  CHECK(mixture[0].kappa == 500);
  CHECK(mixture[0].mean[2] == doctest::Approx(-1));
}

TEST_CASE("the same bits for any number of threads") {
  RandomStream random(6);
  const auto directions = draws_of(any_mixture(4, 2, 2000, random), 30'000, 7);
  const Mixture start = any_mixture(12, 1, 50, random);
  Mixture expected;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Mixture mixture = start;
    fit(mixture, directions, {});
    if (expected.empty()) expected = mixture;
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      CHECK(mixture[k].weight == expected[k].weight);
      CHECK(mixture[k].kappa == expected[k].kappa);
      CHECK(mixture[k].mean == expected[k].mean);
    }
  }
}

}  // namespace
}  // namespace pharos::parallax_aware_mixtures

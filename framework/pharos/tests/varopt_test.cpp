#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/varopt.h>

namespace pharos::statistics {
namespace {

using Reservoir = VarOptReservoir<int>;

std::vector<double> heavy_tailed_weights(int count) {
  std::vector<double> weights;
  RandomStream random(3);
  for (int i = 0; i < count; ++i) weights.push_back(std::pow(1 - random.next_1d(), -1.5));
  return weights;
}

/// Returns a reservoir of item numbers, which were inserted with these weights in this order.
Reservoir filled(const std::vector<double>& weights, const std::vector<int>& order,
                 std::size_t capacity, std::uint64_t seed) {
  Reservoir reservoir(capacity);
  RandomStream random(seed);
  for (const int i : order) reservoir.insert(i, weights[i], random);
  return reservoir;
}

std::vector<int> ascending(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

double output_sum(const Reservoir& reservoir) {
  double sum = 0;
  reservoir.for_each([&](int, double weight) { sum += weight; });
  return sum;
}

TEST_CASE("VAROPT: output weights add up to the inputs, in any order, in constant memory") {
  const std::vector<double> weights = heavy_tailed_weights(5000);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<int> order = ascending(5000);
  for (int arrangement = 0; arrangement < 4; ++arrangement) {
    if (arrangement == 1) std::reverse(order.begin(), order.end());
    if (arrangement == 2) {
      std::sort(order.begin(), order.end(), [&](int a, int b) { return weights[a] < weights[b]; });
    }
    if (arrangement == 3) std::reverse(order.begin(), order.end());
    for (const std::size_t capacity : {1, 2, 7, 100}) {
      const Reservoir reservoir = filled(weights, order, capacity, 11);
      CHECK(reservoir.size() == capacity);
      CHECK(output_sum(reservoir) == doctest::Approx(total).epsilon(1e-12));
      CHECK(reservoir.total_weight() == doctest::Approx(total).epsilon(1e-12));
      for (const auto& entry : reservoir.heavy()) {
        CHECK(entry.weight == weights[entry.item]);
        CHECK(entry.weight > reservoir.threshold());
      }
    }
  }
}

TEST_CASE("VAROPT: the expectation of an output weight is the input, ties included") {
  std::vector<double> weights = heavy_tailed_weights(40);
  std::fill(weights.begin() + 20, weights.begin() + 30, 1.0);
  constexpr int kRuns = 40000;
  std::vector<double> sums(weights.size(), 0), squares(weights.size(), 0);
  const std::vector<int> order = ascending(40);
  for (int run = 0; run < kRuns; ++run) {
    filled(weights, order, 10, 1000 + run).for_each([&](int i, double weight) {
      sums[i] += weight;
      squares[i] += weight * weight;
    });
  }
  double chi_square = 0;
  int compared = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double mean = sums[i] / kRuns;
    const double error = std::sqrt((squares[i] / kRuns - mean * mean) / kRuns);
    if (error > 1e-12) {
      chi_square += std::pow((mean - weights[i]) / error, 2);
      ++compared;
    } else {
      CHECK(mean == doctest::Approx(weights[i]));
    }
  }
  CHECK(compared >= 30);
  CHECK(chi_square < compared + 5 * std::sqrt(2.0 * compared));
}

TEST_CASE("VAROPT: fewer items than places keep their weights; worthless ones are ignored") {
  Reservoir reservoir(8);
  RandomStream random(1);
  for (const double weight : {0.0, -1.0, std::nan(""), 1 / 0.0}) {
    reservoir.insert(0, weight, random);
  }
  CHECK(reservoir.size() == 0);
  for (int i = 1; i <= 8; ++i) reservoir.insert(i, i, random);
  reservoir.for_each([](int i, double weight) { CHECK(weight == i); });
  CHECK(reservoir.threshold() == 0);
}

TEST_CASE("VAROPT: the effective size is the number of equal weights that say as much") {
  RandomStream random(3);
  Reservoir reservoir(8);
  CHECK(reservoir.effective_size() == 0);
  for (int i = 0; i < 4; ++i) reservoir.insert(i, 2, random);
  CHECK(reservoir.effective_size() == doctest::Approx(4));
  reservoir.insert(4, 1e6, random);
  CHECK(reservoir.effective_size() == doctest::Approx(1).epsilon(1e-4));
  for (int i = 5; i < 100; ++i) reservoir.insert(i, 1e6, random);
  CHECK(reservoir.effective_size() == doctest::Approx(8).epsilon(1e-3));
}

TEST_CASE("VAROPT: a reservoir of a reservoir has the same expectations") {
  const std::vector<double> weights = heavy_tailed_weights(30);
  double sum = 0;
  constexpr int kRuns = 20000;
  double squares = 0;
  for (int run = 0; run < kRuns; ++run) {
    RandomStream random(7, run);
    Reservoir second(6);
    filled(weights, ascending(30), 12, 500000 + run).for_each([&](int i, double weight) {
      second.insert(i, weight, random);
    });
    double part = 0;  // output weight of the first half of the items
    second.for_each([&](int i, double weight) { part += i < 15 ? weight : 0; });
    sum += part;
    squares += part * part;
  }
  const double mean = sum / kRuns;
  const double error = std::sqrt((squares / kRuns - mean * mean) / kRuns);
  CHECK(std::abs(mean - std::accumulate(weights.begin(), weights.begin() + 15, 0.0)) < 4 * error);
}

}  // namespace
}  // namespace pharos::statistics

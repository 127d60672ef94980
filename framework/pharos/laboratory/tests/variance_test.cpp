// Tests of variances, their slopes, and the coverage of the intervals.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/laboratory/variance.h>

#include "../../tests/fixtures.h"

namespace pharos::laboratory {
namespace {

/// Standard normal numbers by the method of Box and Muller.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : numbers_(seed) {}
  double operator()() {
    const double u = 1 - numbers_.next_1d(), v = numbers_.next_1d();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  RandomStream numbers_;
};

/// Returns the variance of estimates that are all independent.
VarianceEstimate variance_about(double exact, const std::vector<double>& estimates) {
  return laboratory::variance_about(exact, estimates, estimates.size());
}

const std::vector<double> kNumbers{16, 32, 64, 128, 256, 512, 1024};

/// Returns the variances of estimates that fall as N^-1.5. With `spread`, the errors of each
/// realization have a scale of their own, so the tails are heavy.
std::vector<VarianceEstimate> variances(Normal& normal, int realizations, double spread) {
  std::vector<VarianceEstimate> all;
  for (const double n : kNumbers) {
    std::vector<double> estimates;
    for (int r = 0; r < realizations; ++r) {
      const double scale = std::exp(spread * normal() - spread * spread);
      estimates.push_back(0.3 + scale * std::pow(n, -0.75) * normal());
    }
    all.push_back(variance_about(0.3, estimates));
  }
  return all;
}

TEST_CASE("the variance is about the exact value, not the mean") {
  const std::vector<double> estimates{1, 3};
  CHECK(variance_about(1, estimates).value == 2);
  CHECK(variance_about(2, estimates).value == 1);
}

TEST_CASE("estimates without any error have a variance of zero") {
  const VarianceEstimate v = variance_about(1, {1, 1, 1});
  CHECK(v.value == 0);
  CHECK(v.log_error == 0);
  CHECK_FALSE(ratio(v, variance_about(1, {1, 2})));
  CHECK_FALSE(fitted_slope(std::vector<double>{1, 2, 4}, std::vector<VarianceEstimate>(3, v)));
}

TEST_CASE("equal squares are not taken for certain") {
  const VarianceEstimate v = variance_about(0, {1, -1, 1, -1});
  CHECK(v.value == 1);
  CHECK(v.log_error == doctest::Approx(0.1 * std::sqrt(0.5)));
}

TEST_CASE("the error is that of groups' sums, by Student's t") {
  // The squares are 1, 1, 3, 3. The groups' sums differ by -2 and 2 from their expectation. This
  // gives a standard error of 1 with one degree of freedom, and its quantile is 12.706.
  const double root = std::sqrt(3);
  const VarianceEstimate v =
      laboratory::variance_about(0, std::vector<double>{1, -1, root, -root}, 2);
  CHECK(v.value == doctest::Approx(2));
  CHECK(v.log_error == doctest::Approx(12.7062 / 1.95996 / 2).epsilon(1e-5));
  CHECK(v.interval.high == doctest::Approx(2 * std::exp(12.7062 / 2)).epsilon(1e-4));
  for (std::size_t count = 3; count < 20; ++count) {
    CHECK(group_begin(0, 3, count) == 0);
    CHECK(group_begin(3, 3, count) == count);
    for (std::size_t g = 0; g < 3; ++g) {
      const std::size_t size = group_begin(g + 1, 3, count) - group_begin(g, 3, count);
      CHECK(size >= count / 3);
      CHECK(size <= count / 3 + 1);
    }
  }
}

TEST_CASE("a slope without errors is exact, and a curve widens its interval") {
  std::vector<VarianceEstimate> line, curve;
  for (const double n : kNumbers) {
    line.push_back({std::pow(n, -1.5), 0.1, {}});
    const double x = std::log(n / 128);
    curve.push_back({std::exp(-1.5 * x + x * x), 0.1, {}});
  }
  const auto straight = fitted_slope(kNumbers, line), bent = fitted_slope(kNumbers, curve);
  REQUIRE(straight);
  REQUIRE(bent);
  CHECK(straight->slope.value == doctest::Approx(-1.5));
  CHECK(straight->misfit == doctest::Approx(0));
  // The sum of squared distances from the middle of seven numbers is 28 times the square of ln 2.
  const double error = 0.1 / (std::log(2) * std::sqrt(28));
  CHECK(straight->slope.interval.high - straight->slope.value == doctest::Approx(1.96 * error));
  CHECK(bent->slope.value == doctest::Approx(-1.5));
  CHECK(bent->misfit > 10);
  CHECK(bent->slope.interval.high - bent->slope.value ==
        doctest::Approx(1.96 * error * std::sqrt(bent->misfit)));
}

TEST_CASE("weights follow the errors") {
  // The last number is far off and has a large error.
  std::vector<VarianceEstimate> v;
  for (const double n : {1.0, 2.0, 4.0}) v.push_back({1 / n, 0.01, {}});
  v.push_back({1e3, 1e3, {}});
  const auto slope = fitted_slope(std::vector<double>{1, 2, 4, 8}, v);
  REQUIRE(slope);
  CHECK(slope->slope.value == doctest::Approx(-1).epsilon(1e-3));
}

TEST_CASE("wrong numbers of values are refused") {
  CHECK(test::input_error([] { variance_about(0, {1}); }).find("two groups") != std::string::npos);
  const std::vector<double> three{1, 2, 3};
  for (const std::size_t groups : {0u, 1u, 4u}) {
    CHECK(test::input_error([&] {
            laboratory::variance_about(0, three, groups);
          }).find(std::to_string(groups) + " of 3") != std::string::npos);
  }
  CHECK(test::input_error([] {
          fitted_slope(std::vector<double>{1, 2}, std::vector<VarianceEstimate>(2));
        }).find("three or more") != std::string::npos);
  CHECK(test::input_error([] {
          fitted_slope(std::vector<double>{1, 2, 3}, std::vector<VarianceEstimate>(4));
        }).find("3 and 4") != std::string::npos);
}

/// The shares of repetitions in which the 95 % intervals of variance, ratio and slope contain the
/// true value.
struct Coverage {
  double variance = 0, ratio = 0, slope = 0;
};

Coverage coverage(int realizations, double spread) {
  constexpr int kRepetitions = 800;
  Coverage held;
  Normal normal(17);
  const auto holds = [](const statistics::Interval& i, double truth) {
    return (i.low <= truth && truth <= i.high) ? 1.0 / kRepetitions : 0;
  };
  for (int i = 0; i < kRepetitions; ++i) {
    const std::vector<VarianceEstimate> v = variances(normal, realizations, spread);
    held.variance += holds(v[0].interval, std::pow(kNumbers[0], -1.5));
    held.ratio += holds(ratio(v[1], v[0])->interval, std::pow(2, -1.5));
    held.slope += holds(fitted_slope(kNumbers, v)->slope.interval, -1.5);
  }
  return held;
}

/// Returns the share of intervals that contain the true value if each ten consecutive estimates
/// have a common scale, like the estimates of one preparation may have. `groups` is the number of
/// groups that the intervals assume.
double coverage_of_groups(std::size_t groups) {
  constexpr int kRepetitions = 800;
  constexpr double kSpread = 0.3;
  Normal normal(23);
  double held = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    std::vector<double> estimates;
    double scale = 1;
    for (int r = 0; r < 640; ++r) {
      if (r % 10 == 0) scale = std::exp(kSpread * (normal() - kSpread));
      estimates.push_back(scale * normal());
    }
    const statistics::Interval interval = laboratory::variance_about(0, estimates, groups).interval;
    held += (interval.low <= 1 && 1 <= interval.high) ? 1.0 / kRepetitions : 0;
  }
  return held;
}

TEST_CASE("intervals of groups hold the truth where estimates depend on each other") {
  CHECK(coverage_of_groups(64) >= 0.92);
  CHECK(coverage_of_groups(64) <= 0.98);
  CHECK(coverage_of_groups(16) >= 0.92);
  CHECK(coverage_of_groups(640) < 0.85);
}

TEST_CASE("intervals of normal errors hold the truth in 95 % of cases") {
  // The standard error of a share of 800 is 0.8 %. Misfits that are above 1 by chance widen the
  // intervals of slopes.
  const Coverage held = coverage(400, 0);
  CHECK(held.variance == doctest::Approx(0.95).epsilon(0.03));
  CHECK(held.ratio == doctest::Approx(0.95).epsilon(0.03));
  CHECK(held.slope >= 0.925);
  CHECK(held.slope <= 0.99);
}

TEST_CASE("intervals of heavy-tailed errors hold the truth almost as often") {
  // If each realization has a scale of its own, the second moment of the squares is 3 exp(4
  // spread^2) times their squared mean. Intervals from normal theory would contain the true value
  // in about 85 % of cases.
  const Coverage held = coverage(400, 0.4);
  CHECK(held.variance >= 0.91);
  CHECK(held.ratio >= 0.92);
  CHECK(held.slope >= 0.92);
  CHECK(held.slope <= 0.99);
}

}  // namespace
}  // namespace pharos::laboratory

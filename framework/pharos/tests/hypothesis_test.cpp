#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::statistics {
namespace {

/// Returns the estimate from `n` normal observations about `mean` with standard deviation `sigma`.
Estimate normal_estimate(RandomStream& random, int n, double mean, double sigma) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) {
    const double u = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
    values.push_back(mean + sigma * warp::normal_from_unit(u));
  }
  return estimate(moments(values));
}

}  // namespace

TEST_CASE("moments") {
  const SampleMoments m = moments(std::vector<double>{1, 2, 3, 4});
  CHECK(m.mean == 2.5);
  CHECK(m.variance == doctest::Approx(5.0 / 3));
  CHECK(std::isinf(moments(std::vector<double>{1}).variance));
}

TEST_CASE("Welch's test: a worked example") {
  const Estimate a = estimate({.mean = 20.82, .variance = 7.92, .count = 15});
  const Estimate b = estimate({.mean = 22.99, .variance = 3.79, .count = 15});
  const TestResult result = welch_test(a, b);
  // Computed by hand: the standard error is sqrt(0.528 + 0.252667) = 0.883553.
  CHECK(result.statistic == doctest::Approx(-2.17 / 0.883553).epsilon(1e-5));
  CHECK(result.degrees_of_freedom == doctest::Approx(24.9).epsilon(1e-2));
  CHECK(result.p_value == doctest::Approx(0.0214).epsilon(2e-2));
}

TEST_CASE("one-sample tests: tabulated quantiles") {
  // 2.262 is the 97.5 % point of Student's t with nine degrees of freedom, and 1.959964 is the 97.5
  // % point of the normal distribution.
  const Estimate t{.mean = 2.262157, .squared_error = 1, .degrees_of_freedom = 9};
  CHECK(one_sample_test(t, 0).p_value == doctest::Approx(0.05).epsilon(1e-5));
  const Estimate z{.mean = 1 + 2 * 1.959964, .squared_error = 4};
  CHECK(one_sample_test(z, 1).p_value == doctest::Approx(0.05).epsilon(1e-5));
}

TEST_CASE("estimates without error") {
  const Estimate one{.mean = 1}, two{.mean = 2};
  CHECK(welch_test(one, one).p_value == 1);
  CHECK(welch_test(one, two).p_value == 0);
  CHECK(detectable_difference(one, two, 0.01) == 0);
}

TEST_CASE("estimates of infinite error say nothing") {
  const Estimate known{.mean = 1, .squared_error = 1};
  const Estimate unknown = estimate(moments(std::vector<double>{5}));
  CHECK(welch_test(known, unknown).p_value == 1);
  CHECK(std::isinf(detectable_difference(known, unknown, 0.01)));
}

TEST_CASE("Holm's correction") {
  const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005});
  CHECK(adjusted[0] == doctest::Approx(0.03));
  CHECK(adjusted[1] == doctest::Approx(0.06));
  CHECK(adjusted[2] == doctest::Approx(0.06));
  CHECK(adjusted[3] == doctest::Approx(0.02));
  CHECK(holm_adjusted(std::vector<double>{0.6, 0.7})[1] == 1);
}

TEST_CASE("Welch's test holds its level and finds the detectable difference") {
  constexpr int kTrials = 4000;
  constexpr double kLevel = 0.05;
  RandomStream random(7);
  int alarms = 0, found = 0;
  const Estimate ideal_a{.squared_error = 1.0 / 12, .degrees_of_freedom = 11};
  const Estimate ideal_b{.squared_error = 9.0 / 32, .degrees_of_freedom = 31};
  const double difference = detectable_difference(ideal_a, ideal_b, kLevel, 0.9);
  for (int i = 0; i < kTrials; ++i) {
    const Estimate a = normal_estimate(random, 12, 0, 1), b = normal_estimate(random, 32, 0, 3);
    alarms += welch_test(a, b).p_value < kLevel;
    Estimate moved = b;
    moved.mean += difference;
    found += welch_test(a, moved).p_value < kLevel;
  }
  // The tolerances are four standard errors of a share, plus the slight optimism of the central
  // approximation.
  CHECK(alarms / double{kTrials} == doctest::Approx(kLevel).epsilon(4 * 0.0034 / kLevel));
  CHECK(found / double{kTrials} == doctest::Approx(0.9).epsilon(0.03));
}

}  // namespace pharos::statistics

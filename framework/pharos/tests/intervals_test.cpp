#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/intervals.h>

namespace pharos::statistics {
namespace {

using Values = std::vector<double>;

double normal(RandomStream& random) {
  return warp::normal_from_unit((static_cast<double>(random() >> 11) + 0.5) * 0x1p-53);
}

bool holds(const Interval& interval, double value) {
  return interval.low <= value && value <= interval.high;
}

/// Returns the share of `trials` for which `covered(random)` holds.
template <class Covered>
double coverage(std::uint64_t seed, int trials, Covered&& covered) {
  RandomStream random(seed);
  int count = 0;
  for (int i = 0; i < trials; ++i) count += covered(random);
  return static_cast<double>(count) / trials;
}

constexpr int kTrials = 20'000;
/// Returns four standard errors of a share in kTrials: 0.62 % for a share of 95 %, 1.1 % for 80 %.
double tolerance(double share) {
  return 4 * std::sqrt(share * (1 - share) / kTrials);
}

}  // namespace

TEST_CASE("arithmetic mean: a worked example, one value, none") {
  // The standard deviation is 1, and 4.302653 is the 97.5 % point of Student's t with two degrees
  // of freedom.
  const Bounded mean = arithmetic_mean(Values{-1, 0, 1});
  CHECK(mean.value == doctest::Approx(0));
  CHECK(mean.interval.high == doctest::Approx(4.302653 / std::sqrt(3.0)));
  CHECK(arithmetic_mean(Values{4}).interval.low == -std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(arithmetic_mean(Values{}), InputError);
  CHECK_THROWS_AS(arithmetic_mean(Values{1, std::nan("")}), InputError);
}

TEST_CASE("ratio of two independent means: a worked example, and its coverage") {
  // The logarithms have means 2 and 0, and squared standard errors 1/3 and 4/3. Welch's equation
  // gives (5/3)^2 / ((1/3)^2 / 2 + (4/3)^2 / 2) = 50/17 degrees of freedom. The 97.5 % point of
  // Student's t there is 3.218759.
  const Values a{std::exp(1.0), std::exp(2.0), std::exp(3.0)}, b{std::exp(-2.0), 1, std::exp(2.0)};
  const Bounded ratio = ratio_of_means(a, b);
  CHECK(ratio.value == doctest::Approx(std::exp(2.0)));
  CHECK(std::log(ratio.interval.high) == doctest::Approx(2 + 3.218759 * std::sqrt(5.0 / 3)));
  CHECK(std::log(ratio.interval.low) == doctest::Approx(2 - 3.218759 * std::sqrt(5.0 / 3)));
  CHECK(std::isinf(ratio_of_means(a, Values{1}).interval.high));
  CHECK(ratio_of_means(Values{2, 2}, Values{1, 1}).interval.high == doctest::Approx(2));
  CHECK_THROWS_AS(ratio_of_means(a, Values{1, 0}), InputError);
  CHECK_THROWS_AS(ratio_of_means(Values{}, b), InputError);

  const double share = coverage(11, kTrials, [](RandomStream& random) {
    Values over, under;
    for (int i = 0; i < 5; ++i) over.push_back(std::exp(0.1 * normal(random)));
    for (int i = 0; i < 8; ++i) under.push_back(std::exp(0.3 * normal(random)));
    return holds(ratio_of_means(over, under).interval, 1);
  });
  CHECK(std::abs(share - 0.95) < 0.005 + tolerance(0.95));  // Welch's interval is approximate
}

TEST_CASE("geometric mean: a worked example") {
  // The logarithms 0, 1 and 2 have mean 1 and standard deviation 1. The 97.5 % point of Student's t
  // with two degrees of freedom is 4.302653.
  const Bounded mean = geometric_mean(Values{1, std::exp(1.0), std::exp(2.0)});
  CHECK(mean.value == doctest::Approx(std::exp(1.0)));
  CHECK(std::log(mean.interval.low) == doctest::Approx(1 - 4.302653 / std::sqrt(3.0)));
  CHECK(std::log(mean.interval.high) == doctest::Approx(1 + 4.302653 / std::sqrt(3.0)));
  // 1.885618 is the 90 % point.
  const Bounded wide = geometric_mean(Values{1, std::exp(1.0), std::exp(2.0)}, 0.8);
  CHECK(std::log(wide.interval.high) == doctest::Approx(1 + 1.885618 / std::sqrt(3.0)));
}

TEST_CASE("geometric mean: equal values are known exactly, one value not at all") {
  const Bounded same = geometric_mean(Values{4, 4, 4});
  CHECK(same.value == doctest::Approx(4));
  CHECK(same.interval.low == same.value);
  CHECK(same.interval.high == same.value);
  const Bounded one = geometric_mean(Values{4});
  CHECK(one.value == doctest::Approx(4));
  CHECK(one.interval.low == 0);
  CHECK(std::isinf(one.interval.high));
}

TEST_CASE("ratios are taken pair by pair") {
  // A factor that both values share does not widen the interval.
  const Bounded ratio = mean_ratio(Values{2, 200, 0.02}, Values{1, 100, 0.01});
  CHECK(ratio.value == doctest::Approx(2));
  CHECK(ratio.interval.low == doctest::Approx(2));
  CHECK(ratio.interval.high == doctest::Approx(2));
  const Bounded spread = mean_ratio(Values{2, 8}, Values{1, 1});
  CHECK(spread.value == doctest::Approx(4));
  // 12.7062 is the 97.5 % point with one degree of freedom; the logarithms are ln 4 -+ ln 2.
  CHECK(std::log(spread.interval.high) ==
        doctest::Approx(std::log(4.0) + 12.7062 * std::log(2.0)).epsilon(1e-5));
}

TEST_CASE("slope: a worked example") {
  // y = 1 + 2 x + residuals (1, -2, 1) / 10, which sum to zero and are orthogonal to x.
  const Bounded slope = fitted_slope(Values{0, 1, 2}, Values{1.1, 2.8, 5.1});
  CHECK(slope.value == doctest::Approx(2));
  const double error = std::sqrt(0.06 / 1 / 2);
  CHECK(slope.interval.low == doctest::Approx(2 - 12.7062 * error).epsilon(1e-5));
  CHECK(slope.interval.high == doctest::Approx(2 + 12.7062 * error).epsilon(1e-5));
}

TEST_CASE("slope: points on a line, two points") {
  const Bounded line = fitted_slope(Values{1, 2, 4, 8}, Values{-1, -2, -4, -8});
  CHECK(line.value == doctest::Approx(-1));
  CHECK(line.interval.high - line.interval.low < 1e-12);
  const Bounded two = fitted_slope(Values{1, 2}, Values{3, 5});
  CHECK(two.value == doctest::Approx(2));
  CHECK(two.interval.low == -std::numeric_limits<double>::infinity());
  CHECK(two.interval.high == std::numeric_limits<double>::infinity());
}

TEST_CASE("intervals hold the truth as often as they claim") {
  for (const double confidence : {0.95, 0.8}) {
    for (const int n : {3, 8}) {
      CAPTURE(confidence);
      CAPTURE(n);
      const double mean = coverage(1, kTrials, [&](RandomStream& random) {
        Values values;
        for (int i = 0; i < n; ++i) values.push_back(std::exp(0.7 + 1.5 * normal(random)));
        return holds(geometric_mean(values, confidence).interval, std::exp(0.7));
      });
      CHECK(std::abs(mean - confidence) < tolerance(confidence));
      const double ratio = coverage(2, kTrials, [&](RandomStream& random) {
        Values a, b;
        for (int i = 0; i < n; ++i) {
          const double common = normal(random);
          a.push_back(std::exp(common + 0.3 * normal(random)));
          b.push_back(3 * std::exp(common + 0.2 * normal(random)));
        }
        return holds(mean_ratio(a, b, confidence).interval, 1.0 / 3);
      });
      CHECK(std::abs(ratio - confidence) < tolerance(confidence));
      const double slope = coverage(3, kTrials, [&](RandomStream& random) {
        Values x, y;
        for (int i = 0; i < n; ++i) {
          x.push_back(i * i);
          y.push_back(5 - x.back() + normal(random));
        }
        return holds(fitted_slope(x, y, confidence).interval, -1);
      });
      CHECK(std::abs(slope - confidence) < tolerance(confidence));
    }
  }
}

TEST_CASE("intervals: bad input") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(geometric_mean(Values{}), InputError);
  CHECK_THROWS_AS(geometric_mean(Values{1, 0}), InputError);
  CHECK_THROWS_AS(geometric_mean(Values{1, -1}), InputError);
  CHECK_THROWS_AS(geometric_mean(Values{1, kNan}), InputError);
  CHECK_THROWS_AS(geometric_mean(Values{1, std::numeric_limits<double>::infinity()}), InputError);
  CHECK_THROWS_AS(geometric_mean(Values{1, 2}, 1), InputError);
  CHECK_THROWS_AS(geometric_mean(Values{1, 2}, 0), InputError);
  CHECK_THROWS_AS(mean_ratio(Values{1, 2}, Values{1}), InputError);
  CHECK_THROWS_AS(mean_ratio(Values{1, 2}, Values{1, 0}), InputError);
  CHECK_THROWS_AS(fitted_slope(Values{1, 2}, Values{1}), InputError);
  CHECK_THROWS_AS(fitted_slope(Values{1}, Values{1}), InputError);
  CHECK_THROWS_AS(fitted_slope(Values{2, 2, 2}, Values{1, 2, 3}), InputError);
  CHECK_THROWS_AS(fitted_slope(Values{1, 2, 3}, Values{1, 2, kNan}), InputError);
}

}  // namespace pharos::statistics

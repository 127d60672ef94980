#pragma once

#include <limits>
#include <span>
#include <vector>

/// Tests of means, with the difference that they are able to see. All p-values are two-sided.
namespace pharos::statistics {

/// Mean, unbiased variance and number of independent observations.
struct Moments {
  double mean = 0;
  double variance = 0;
  double count = 0;
};
/// Moments of `values`; the variance of fewer than two is infinite.
Moments moments(std::span<const double> values);

/// An estimated mean with its squared standard error and the degrees of freedom of the latter
/// (infinite when the error is known).
struct Estimate {
  double mean = 0;
  double squared_error = 0;
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
};
/// The mean of independent observations.
Estimate estimate(const Moments& moments);

struct TestResult {
  double statistic = 0;  ///< difference in standard errors, signed
  double degrees_of_freedom = 0;
  double p_value = 1;  ///< without any error: 1 for equal means, else 0
};

/// Whether two means are equal: Welch's t-test (Welch 1947, with the degrees of freedom of
/// Satterthwaite 1946). Two estimates of known error make it a z-test.
TestResult welch_test(const Estimate& a, const Estimate& b);
/// Whether a mean is `expected`: one-sample t-test, a z-test when the error is known.
TestResult one_sample_test(const Estimate& a, double expected);

/// The true difference of means that welch_test() at level `significance` finds with probability
/// `power`, by the central t approximation (sum of both quantiles), for (a, b)'s errors.
double detectable_difference(const Estimate& a, const Estimate& b, double significance,
                             double power = 0.9);

/// P-values adjusted for testing all of them (Holm 1979), in the given order: those at or below a
/// level are rejected with that family-wise error rate.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace pharos::statistics

#pragma once

#include <limits>
#include <span>
#include <vector>

/// Tests of means, and the differences that these tests can detect. All p-values are two-sided.
namespace pharos::statistics {

/// The mean, the unbiased variance and the number of independent observations.
struct SampleMoments {
  double mean = 0;
  double variance = 0;
  double count = 0;
};
/// Returns the moments of `values`. The variance of fewer than two values is infinite.
SampleMoments moments(std::span<const double> values);

/// An estimated mean with its squared standard error and the degrees of freedom of this error
/// (infinite if the error is known).
struct Estimate {
  double mean = 0;
  double squared_error = 0;
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
};
/// Estimates the mean of independent observations.
Estimate estimate(const SampleMoments& moments);

struct TestResult {
  double statistic = 0;  ///< signed difference [standard errors]
  double degrees_of_freedom = 0;
  double p_value = 1;  ///< if the standard error is zero: 1 for equal means, else 0
};

/// Tests whether two means are equal by Welch's t-test (Welch 1947, with the degrees of freedom of
/// Satterthwaite 1946). The test is a z-test if both errors are known.
TestResult welch_test(const Estimate& a, const Estimate& b);
/// Tests whether a mean is `expected` by a one-sample t-test, or by a z-test if the error is known.
TestResult one_sample_test(const Estimate& a, double expected);

/// Returns the true difference of means that welch_test() at level `significance` detects with
/// probability `power`, for the errors of a and b. Uses the central t approximation (sum of both
/// quantiles).
double detectable_difference(const Estimate& a, const Estimate& b, double significance,
                             double power = 0.9);

/// Adjusts p-values for testing all of them (Holm 1979) and returns them in the given order. A
/// family that rejects all adjusted p-values at or below a level has this level as its family-wise
/// error rate.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace pharos::statistics

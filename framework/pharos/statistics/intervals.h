#pragma once

#include <span>

/// Estimates from a few observations with their confidence intervals. All functions throw
/// InputError for spans of different lengths, for values that are not finite, and for a confidence
/// outside (0, 1).
namespace pharos::statistics {

/// A confidence interval.
struct Interval {
  double low = 0, high = 0;
};

/// An estimate with its confidence interval.
struct Bounded {
  double value = 0;
  Interval interval;
};

/// Returns the arithmetic mean with its confidence interval by Student's t. The interval of a
/// single value is (-infinity, infinity). Throws InputError if there is no value.
Bounded arithmetic_mean(std::span<const double> values, double confidence = 0.95);

/// Returns the geometric mean of positive values with its confidence interval by Student's t on
/// their logarithms. The interval of a single value is [0, infinity). Throws InputError if there is
/// no value or if a value is not positive.
Bounded geometric_mean(std::span<const double> values, double confidence = 0.95);

/// Returns the geometric mean of the ratios a[i] / b[i] of paired positive values with its
/// confidence interval. Throws InputError like geometric_mean().
Bounded mean_ratio(std::span<const double> a, std::span<const double> b, double confidence = 0.95);

/// Returns the ratio of the geometric means of two independent samples of positive values, a over
/// b, with its confidence interval by Welch's t on their logarithms. The interval is [0, infinity)
/// if a sample has a single value. Throws InputError like geometric_mean().
Bounded ratio_of_means(std::span<const double> a, std::span<const double> b,
                       double confidence = 0.95);

/// Returns the slope of the least-squares line of y over x with its confidence interval by
/// Student's t. The interval for two points is (-infinity, infinity). Throws InputError if x holds
/// fewer than two different values.
Bounded fitted_slope(std::span<const double> x, std::span<const double> y,
                     double confidence = 0.95);

}  // namespace pharos::statistics

#pragma once

#include <span>

/// Estimates of a few observations with their intervals of confidence. All functions throw
/// InputError for spans of different lengths, values that are not finite, and a confidence outside
/// (0, 1).
namespace pharos::statistics {

/// An interval of confidence.
struct Interval {
  double low = 0, high = 0;
};

/// An estimate with its interval of confidence.
struct Bounded {
  double value = 0;
  Interval interval;
};

/// The arithmetic mean with its interval of confidence by Student's t; the interval of a single
/// value is (-infinity, infinity). Throws InputError for no value at all.
Bounded arithmetic_mean(std::span<const double> values, double confidence = 0.95);

/// The geometric mean of positive values with its interval of confidence by Student's t on their
/// logarithms; the interval of a single value is [0, infinity). Throws InputError for no value at
/// all and for values that are not positive.
Bounded geometric_mean(std::span<const double> values, double confidence = 0.95);

/// The geometric mean of the ratios a[i] / b[i] of paired positive values, with its interval.
/// Throws as geometric_mean() does.
Bounded mean_ratio(std::span<const double> a, std::span<const double> b, double confidence = 0.95);

/// The slope of a straight line of y over x in least squares, with Student's interval; of two
/// points it is (-infinity, infinity). Throws InputError when x holds fewer than two different
/// values.
Bounded fitted_slope(std::span<const double> x, std::span<const double> y,
                     double confidence = 0.95);

}  // namespace pharos::statistics

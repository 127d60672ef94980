#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <pharos/statistics/intervals.h>

/// Variances of estimators with a known expectation, and the slopes of their decrease.
namespace pharos::laboratory {

/// A variance with its statistical error.
struct VarianceEstimate {
  double value = 0;
  double log_error = 0;  ///< standard error of the natural logarithm; 0 if the variance is zero
  statistics::Interval interval;  ///< 95 % interval
};

/// Returns the first index of group `group` when `count` consecutive values are divided among
/// `groups`. Sizes differ by one at most.
constexpr std::size_t group_begin(std::size_t group, std::size_t groups, std::size_t count) {
  return group * count / groups;
}

/// Returns the mean square of the differences between the estimates and the exact value. It is the
/// variance of an unbiased estimator, and includes the bias of any other estimator.
///
/// Only the groups of estimates defined by group_begin() need to be independent of each other. The
/// standard error comes from the spread of the groups' sums of squares, so it assumes neither
/// normal errors nor equal groups. It is widened by the ratio of Student's quantile to the normal
/// quantile, which matters if there are few groups. At least a tenth of the standard error of
/// normal estimates is assumed. The interval is normal in the logarithm. Throws InputError for
/// fewer than two groups and for empty groups.
VarianceEstimate variance_about(double exact, std::span<const double> estimates,
                                std::size_t groups);

/// Returns the ratio of two independent variances with its 95 % interval, which is normal in the
/// logarithm; empty if one of them is zero.
std::optional<statistics::Bounded> ratio(const VarianceEstimate& a, const VarianceEstimate& b);

/// The decrease of variances over numbers of points.
struct VarianceSlope {
  statistics::Bounded slope;  ///< slope of log variance over log number, with its 95 % interval
  /// The chi-square of the residuals divided by the degrees of freedom: near 1 if the variances lie
  /// on a straight line, larger if they do not.
  double misfit = 0;
};

/// Fits a straight line through log variance over log number of points, each weighted by the
/// inverse square of its own log_error. The interval is normal, from the log_errors. If the misfit
/// is above 1, the interval is widened by the misfit's square root (Birge 1932), because a curve
/// has no single slope. The variances must be independent. Returns empty if one of them is zero.
/// Throws InputError for fewer than three variances, and for spans of different lengths.
std::optional<VarianceSlope> fitted_slope(std::span<const double> numbers,
                                          std::span<const VarianceEstimate> variances);

}  // namespace pharos::laboratory

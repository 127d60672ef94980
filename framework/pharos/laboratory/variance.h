#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <pharos/statistics/intervals.h>

/// Variances of estimators whose expectation is known, and how they fall.
namespace pharos::laboratory {

/// A variance with what is known of its error.
struct VarianceEstimate {
  double value = 0;
  double log_error = 0;  ///< standard error of the natural logarithm; 0 for a variance of zero
  statistics::Interval interval;  ///< of 95 %
};

/// Where group `group` begins when `count` values in a row are divided among `groups`: sizes differ
/// by one at most.
constexpr std::size_t group_begin(std::size_t group, std::size_t groups, std::size_t count) {
  return group * count / groups;
}

/// The mean square of the differences between the estimates and the exact value, which is the
/// variance of an unbiased estimator (and includes the bias of another). Only the groups of
/// estimates that group_begin() tells apart need to be independent of each other. The standard
/// error comes from the spread of the groups' sums of squares, so it does not suppose normal errors
/// or equal groups; where groups are few it is widened as Student's quantile is over the normal
/// one. At least a tenth of the standard error that normal estimates have is assumed. The interval
/// is normal in the logarithm. Throws InputError for fewer than two groups and for empty ones.
VarianceEstimate variance_about(double exact, std::span<const double> estimates,
                                std::size_t groups);

/// A ratio of two independent variances with its interval of 95 %, normal in the logarithm; none
/// when one of them is zero.
std::optional<statistics::Bounded> ratio(const VarianceEstimate& a, const VarianceEstimate& b);

/// How variances fall over numbers of points.
struct VarianceSlope {
  statistics::Bounded slope;  ///< of log variance over log number, interval of 95 %
  /// The residuals' chi-square by degrees of freedom: near 1 where the variances lie on a straight
  /// line, larger where they do not.
  double misfit = 0;
};

/// A straight line through log variance over log number of points, each weighted by the inverse
/// square of its own log_error. The interval is normal, from the log_errors; where the misfit is
/// above 1 it is widened by the misfit's square root (Birge 1932), since a curve has no one slope.
/// The variances must be independent. None when one of them is zero. Throws InputError for fewer
/// than three, and for spans of different lengths.
std::optional<VarianceSlope> fitted_slope(std::span<const double> numbers,
                                          std::span<const VarianceEstimate> variances);

}  // namespace pharos::laboratory

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

#include <pharos/statistics/hypothesis.h>

namespace pharos::statistics {
namespace {

using StudentT = boost::math::students_t_distribution<double>;

TestResult test_difference(double difference, double squared_error, double degrees_of_freedom) {
  TestResult result{.degrees_of_freedom = degrees_of_freedom};
  if (squared_error == 0) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (difference != 0) result = {std::copysign(kInfinite, difference), degrees_of_freedom, 0};
    return result;
  }
  result.statistic = difference / std::sqrt(squared_error);
  if (!std::isfinite(squared_error)) return result;
  const StudentT t(degrees_of_freedom);
  result.p_value = 2 * boost::math::cdf(boost::math::complement(t, std::abs(result.statistic)));
  return result;
}

/// Returns Satterthwaite's degrees of freedom of a sum of two squared errors.
double joint_degrees_of_freedom(const Estimate& a, const Estimate& b) {
  const double sum = a.squared_error + b.squared_error;
  if (sum == 0) return std::numeric_limits<double>::infinity();
  const double sa = a.squared_error / sum, sb = b.squared_error / sum;
  return 1 / (sa * sa / a.degrees_of_freedom + sb * sb / b.degrees_of_freedom);
}

}  // namespace

SampleMoments moments(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double variance = n < 2 ? std::numeric_limits<double>::infinity() : squares / (n - 1);
  return {mean, variance, n};
}

Estimate estimate(const SampleMoments& m) {
  return {m.mean, m.variance / m.count, std::max(1.0, m.count - 1)};
}

TestResult welch_test(const Estimate& a, const Estimate& b) {
  return test_difference(a.mean - b.mean, a.squared_error + b.squared_error,
                         joint_degrees_of_freedom(a, b));
}

TestResult one_sample_test(const Estimate& a, double expected) {
  return test_difference(a.mean - expected, a.squared_error, a.degrees_of_freedom);
}

double detectable_difference(const Estimate& a, const Estimate& b, double significance,
                             double power) {
  const double squared_error = a.squared_error + b.squared_error;
  if (squared_error == 0 || !std::isfinite(squared_error)) return squared_error;
  const StudentT t(joint_degrees_of_freedom(a, b));
  const double reject = boost::math::quantile(boost::math::complement(t, significance / 2));
  return std::sqrt(squared_error) * (reject + boost::math::quantile(t, power));
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double factor = static_cast<double>(order.size() - k);
    largest = std::max(largest, std::min(1.0, factor * p_values[order[k]]));
    adjusted[order[k]] = largest;
  }
  return adjusted;
}

}  // namespace pharos::statistics

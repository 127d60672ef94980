#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/statistics/hypothesis.h>
#include <pharos/statistics/intervals.h>

namespace pharos::statistics {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Returns how many standard errors an interval extends to either side.
double student_factor(double degrees_of_freedom, double confidence) {
  if (!(confidence > 0 && confidence < 1)) {
    throw InputError(
        fmt::format("expected a confidence above 0 and below 1, found {}", confidence));
  }
  if (degrees_of_freedom < 1) return kInfinite;
  const boost::math::students_t_distribution<double> t(degrees_of_freedom);
  return boost::math::quantile(boost::math::complement(t, (1 - confidence) / 2));
}

void check_paired(std::span<const double> a, std::span<const double> b) {
  if (a.size() == b.size()) return;
  throw InputError(fmt::format("expected as many values as their partners, found {} and {}",
                               a.size(), b.size()));
}

void check_finite(std::span<const double> values) {
  if (std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) return;
  throw InputError("expected finite values, found one that is not");
}

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> logs;
  for (const double v : values) {
    if (!(v > 0) || !std::isfinite(v)) {
      throw InputError(fmt::format("expected positive values for a geometric mean, found {}", v));
    }
    logs.push_back(std::log(v));
  }
  return logs;
}

/// Returns the exponential of the mean of `logs` and of its interval.
Bounded exponential_of_mean(std::span<const double> logs, double confidence) {
  const Bounded mean = arithmetic_mean(logs, confidence);
  return {std::exp(mean.value), {std::exp(mean.interval.low), std::exp(mean.interval.high)}};
}

}  // namespace

Bounded arithmetic_mean(std::span<const double> values, double confidence) {
  if (values.empty()) throw InputError("expected at least one value for a mean");
  check_finite(values);
  const SampleMoments m = moments(values);
  const double factor = student_factor(m.count - 1, confidence);
  const double reach = factor * std::sqrt(m.variance / m.count);
  return {m.mean, {m.mean - reach, m.mean + reach}};
}

Bounded geometric_mean(std::span<const double> values, double confidence) {
  return exponential_of_mean(logarithms(values), confidence);
}

Bounded mean_ratio(std::span<const double> a, std::span<const double> b, double confidence) {
  check_paired(a, b);
  std::vector<double> differences = logarithms(a);
  const std::vector<double> below = logarithms(b);
  for (std::size_t i = 0; i < below.size(); ++i) differences[i] -= below[i];
  return exponential_of_mean(differences, confidence);
}

Bounded ratio_of_means(std::span<const double> a, std::span<const double> b, double confidence) {
  if (a.empty() || b.empty()) throw InputError("expected at least one value for a mean");
  const SampleMoments over = moments(logarithms(a)), under = moments(logarithms(b));
  const double over_error = over.variance / over.count, under_error = under.variance / under.count;
  const double error = over_error + under_error;
  double freedom = 0;
  if (over.count > 1 && under.count > 1) {
    // The equation of Welch and Satterthwaite. Without spread, any number of degrees will do.
    freedom = error > 0 ? error * error /
                              (over_error * over_error / (over.count - 1) +
                               under_error * under_error / (under.count - 1))
                        : over.count + under.count - 2;
  }
  const double factor = student_factor(freedom, confidence);
  const double reach = std::isinf(factor) ? kInfinite : factor * std::sqrt(error);
  const double difference = over.mean - under.mean;
  return {std::exp(difference), {std::exp(difference - reach), std::exp(difference + reach)}};
}

Bounded fitted_slope(std::span<const double> x, std::span<const double> y, double confidence) {
  check_paired(x, y);
  check_finite(x);
  check_finite(y);
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0)) throw InputError("expected points at two different places for a slope");
  const double slope = xy / xx;
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - mean_y - slope * (x[i] - mean_x);
    squares += residual * residual;
  }
  const double factor = student_factor(n - 2, confidence);
  const double reach = n < 3 ? kInfinite : factor * std::sqrt(squares / (n - 2) / xx);
  return {slope, {slope - reach, slope + reach}};
}

}  // namespace pharos::statistics

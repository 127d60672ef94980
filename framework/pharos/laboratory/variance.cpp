#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/laboratory/variance.h>

namespace pharos::laboratory {
namespace {

/// The half width of the central 95 % of a normal distribution [standard deviations].
constexpr double kReach = 1.959963984540054;

/// The smallest log_error, as a fraction of the log_error of normal estimates, which is sqrt(2 /
/// count). Estimates with only a few discrete values may have equal squares. With an error of zero,
/// they alone would determine a fitted slope.
constexpr double kLeastOfNormal = 0.1;

/// The sums of a weighted straight line fit.
struct LineSums {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0;
};

LineSums centered_sums(std::span<const double> x, std::span<const double> y,
                       std::span<const double> weights) {
  LineSums sums;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums.weight += weights[i];
    sums.x += weights[i] * x[i];
    sums.y += weights[i] * y[i];
  }
  sums.x /= sums.weight;
  sums.y /= sums.weight;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums.xx += weights[i] * (x[i] - sums.x) * (x[i] - sums.x);
    sums.xy += weights[i] * (x[i] - sums.x) * (y[i] - sums.y);
  }
  return sums;
}

/// Returns the standard error of the mean of values of which only groups are independent. It is
/// scaled such that an interval of kReach standard errors contains the mean in 95 % of cases.
double error_of_mean(std::span<const double> values, double mean, std::size_t groups) {
  double spread = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    double excess = 0;
    const std::size_t end = group_begin(g + 1, groups, values.size());
    for (std::size_t i = group_begin(g, groups, values.size()); i < end; ++i) {
      excess += values[i] - mean;
    }
    spread += excess * excess;
  }
  const auto degrees = static_cast<double>(groups - 1);
  const double student = boost::math::quantile(boost::math::students_t(degrees), 0.975);
  return student / kReach * std::sqrt(spread * (degrees + 1) / degrees) /
         static_cast<double>(values.size());
}

}  // namespace

VarianceEstimate variance_about(double exact, std::span<const double> estimates,
                                std::size_t groups) {
  if (groups < 2 || groups > estimates.size()) {
    throw InputError(
        fmt::format("expected two groups of estimates or more, none empty, found {} of {}", groups,
                    estimates.size()));
  }
  std::vector<double> squares;
  squares.reserve(estimates.size());
  for (const double e : estimates) squares.push_back((e - exact) * (e - exact));
  const auto count = static_cast<double>(squares.size());
  const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / count;
  if (mean == 0) return {};
  const double least = kLeastOfNormal * std::sqrt(2 / count);
  const double log_error = std::max(error_of_mean(squares, mean, groups) / mean, least);
  const double factor = std::exp(kReach * log_error);
  return {mean, log_error, {mean / factor, mean * factor}};
}

std::optional<statistics::Bounded> ratio(const VarianceEstimate& a, const VarianceEstimate& b) {
  if (a.value == 0 || b.value == 0) return std::nullopt;
  const double value = a.value / b.value;
  const double factor = std::exp(kReach * std::hypot(a.log_error, b.log_error));
  return statistics::Bounded{value, {value / factor, value * factor}};
}

std::optional<VarianceSlope> fitted_slope(std::span<const double> numbers,
                                          std::span<const VarianceEstimate> variances) {
  if (numbers.size() != variances.size() || numbers.size() < 3) {
    throw InputError(
        fmt::format("expected three or more numbers with a variance each, found {} "
                    "and {}",
                    numbers.size(), variances.size()));
  }
  std::vector<double> x, y, weights;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const VarianceEstimate& v = variances[i];
    if (v.value == 0) return std::nullopt;
    x.push_back(std::log(numbers[i]));
    y.push_back(std::log(v.value));
    weights.push_back(1 / (v.log_error * v.log_error));
  }
  const LineSums sums = centered_sums(x, y, weights);
  const double slope = sums.xy / sums.xx;
  double chi_square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - sums.y - slope * (x[i] - sums.x);
    chi_square += weights[i] * residual * residual;
  }
  const double misfit = chi_square / static_cast<double>(x.size() - 2);
  const double reach = kReach * std::sqrt(std::max(1.0, misfit) / sums.xx);
  return VarianceSlope{{slope, {slope - reach, slope + reach}}, misfit};
}

}  // namespace pharos::laboratory

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <pharos/core/parallel.h>
#include <pharos/core/simd.h>
#include <pharos/statistics/gaussian.h>

/// Mixtures of normal distributions and their fit to weighted points by maximum a posteriori
/// expectation-maximization.
namespace pharos::statistics {

/// The density sum_k weights[k] N(x; components[k]). The weights are positive and add up to one.
template <int D>
struct GaussianMixture {
  std::vector<double> weights;
  std::vector<Gaussian<D>> components;

  std::size_t size() const { return weights.size(); }
};

/// Points with weights >= 0, stored coordinate by coordinate in whole registers. Padding in the
/// last register has weight 0.
template <int D>
class WeightedPoints {
 public:
  static constexpr std::size_t kWidth = 4;

  void add(const Vector<D>& x, double weight) {
    if (size_ % kWidth == 0) {
      for (auto& values : values_) values.resize(size_ + kWidth, 0);
      // The padding repeats the point instead of zeros: its density is as harmless as the density
      // of the other points.
      for (int axis = 0; axis < D; ++axis) {
        std::fill_n(values_[axis].end() - kWidth, kWidth, x[axis]);
      }
    }
    for (int axis = 0; axis < D; ++axis) values_[axis][size_] = x[axis];
    values_[D][size_++] = weight;
  }
  std::size_t size() const { return size_; }
  Vector<D> point(std::size_t i) const {
    Vector<D> x;
    for (int axis = 0; axis < D; ++axis) x[axis] = values_[axis][i];
    return x;
  }
  double weight(std::size_t i) const { return values_[D][i]; }

  std::size_t registers() const { return (size_ + kWidth - 1) / kWidth; }
  /// Returns the four points of register r; weights4() returns their weights.
  std::array<Double4, D> points4(std::size_t r) const {
    std::array<Double4, D> x;
    for (int axis = 0; axis < D; ++axis) x[axis] = load4(&values_[axis][r * kWidth]);
    return x;
  }
  Double4 weights4(std::size_t r) const { return load4(&values_[D][r * kWidth]); }

 private:
  std::array<std::vector<double>, D + 1> values_;  ///< the coordinates, then the weights
  std::size_t size_ = 0;
};

/// The prior of a mixture, before any point is seen.
struct MixturePrior {
  double counts = 0;    ///< points in every component: a Dirichlet prior of the weights
  double strength = 0;  ///< weight of the inverse Wishart prior of the covariances [points]
  double variance = 0;  ///< isotropic covariance towards which this prior pulls [unit^2]
};

/// The settings of a fit: what stays, what changes, and when the fit ends.
template <int D>
struct MixtureFit {
  /// Moments of points seen earlier, one for each component. They are added unchanged. Empty: none.
  std::span<const Moments<D>> frozen;
  MixturePrior prior;
  /// The smallest eigenvalue of each component's covariance [unit^2]. Empty: no limit.
  std::span<const double> floors;
  /// The indices of the components that change. The other components keep their weights. Empty: all
  /// components change.
  std::span<const std::size_t> changing;
  int most_iterations = 100;
  /// The fit ends when a step raises objective() by less than this value per point. (A tolerance
  /// relative to objective() would depend on the unit of length.)
  double tolerance = 0.005;
};

/// The result of an E step: the assignment of points to components, and the likelihood of the
/// points.
template <int D>
struct Expectation {
  std::vector<Moments<D>> moments;  ///< of the points of each component, weighted by responsibility
  double log_likelihood = 0;        ///< sum of w log p(x)
};

namespace detail {

/// Moments of four streams of points, summed side by side.
template <int D>
struct Moments4 {
  Double4 weight{};
  std::array<Double4, D> first{};
  std::array<Double4, D*(D + 1) / 2> second{};

  void add(const Double4& w, const std::array<Double4, D>& x) {
    weight += w;
    for (int row = 0, i = 0; row < D; ++row) {
      const Double4 weighted = w * x[row];
      first[row] += weighted;
      for (int column = 0; column <= row; ++column) second[i++] += weighted * x[column];
    }
  }
  Moments<D> summed() const {
    Moments<D> sums;
    sums.weight = sum(weight);
    for (int row = 0, i = 0; row < D; ++row) {
      sums.first[row] = sum(first[row]);
      for (int column = 0; column <= row; ++column) {
        sums.second(row, column) = sums.second(column, row) = sum(second[i++]);
      }
    }
    return sums;
  }
};

/// Computes the expectation over registers [begin, end) of the points.
template <int D>
Expectation<D> expectation_of_part(const std::vector<LogDensity<D>>& densities,
                                   const std::vector<double>& log_weights,
                                   const WeightedPoints<D>& points, std::size_t begin,
                                   std::size_t end) {
  const std::size_t count = densities.size();
  std::vector<Moments4<D>> moments(count);
  std::vector<Double4> terms(count);
  Double4 log_likelihood{};
  for (std::size_t r = begin; r < end; ++r) {
    const std::array<Double4, D> x = points.points4(r);
    const Double4 w = points.weights4(r);
    Double4 largest = all4(-std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < count; ++k) {
      terms[k] = densities[k](x) + log_weights[k];
      largest = larger(largest, terms[k]);
    }
    Double4 total{};
    for (std::size_t k = 0; k < count; ++k) {
      terms[k] = exp(terms[k] - largest);
      total += terms[k];
    }
    for (int i = 0; i < 4; ++i) {
      log_likelihood[i] += w[i] > 0 ? w[i] * (largest[i] + std::log(total[i])) : 0.0;
    }
    const Double4 share = w / total;
    for (std::size_t k = 0; k < count; ++k) moments[k].add(share * terms[k], x);
  }
  Expectation<D> result;
  for (const Moments4<D>& m : moments) result.moments.push_back(m.summed());
  result.log_likelihood = sum(log_likelihood);
  return result;
}

}  // namespace detail

/// Computes the E step by log-sum-exp, so no point is too far from all components. Parts of the
/// points run concurrently and are added in order, so the result is the same for any number of
/// threads.
template <int D>
Expectation<D> expectation(const GaussianMixture<D>& mixture, const WeightedPoints<D>& points) {
  constexpr std::size_t kRegistersAPart = 1024;
  std::vector<LogDensity<D>> densities;
  std::vector<double> log_weights;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    densities.emplace_back(mixture.components[k]);
    log_weights.push_back(std::log(mixture.weights[k]));
  }
  const std::size_t registers = points.registers();
  std::vector<Expectation<D>> parts((registers + kRegistersAPart - 1) / kRegistersAPart);
  parallel_for(parts.size(), [&](std::size_t i) {
    const std::size_t begin = i * kRegistersAPart;
    parts[i] = detail::expectation_of_part(densities, log_weights, points, begin,
                                           std::min(begin + kRegistersAPart, registers));
  });
  Expectation<D> all{std::vector<Moments<D>>(mixture.size()), 0};
  for (const Expectation<D>& part : parts) {
    for (std::size_t k = 0; k < mixture.size(); ++k) all.moments[k] += part.moments[k];
    all.log_likelihood += part.log_likelihood;
  }
  return all;
}

/// Returns the most probable covariance of points with these moments about their mean, given the
/// prior: (strength variance I + scatter) / (strength + weight). No eigenvalue is below `floor`.
template <int D>
Matrix<D> map_covariance(const Moments<D>& moments, const MixturePrior& prior, double floor) {
  const Matrix<D> scatter = moments.scatter(moments.mean());
  const Matrix<D> pulled = prior.strength * prior.variance * Matrix<D>::Identity() + scatter;
  return with_eigenvalues_above<D>(floor, pulled / (prior.strength + moments.weight));
}

/// Computes the M step: sets the components and weights to the most probable ones for these
/// moments. fit.frozen is not added to the moments. Components without weight keep their mean and
/// covariance.
template <int D>
void maximize(std::span<const Moments<D>> moments, const MixtureFit<D>& fit,
              GaussianMixture<D>& mixture) {
  const bool all = fit.changing.empty();
  const std::size_t count = all ? mixture.size() : fit.changing.size();
  double seen = 0, share = 0;  // of the components that change
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = all ? i : fit.changing[i];
    seen += moments[k].weight + fit.prior.counts;
    share += mixture.weights[k];
  }
  if (!(seen > 0)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = all ? i : fit.changing[i];
    mixture.weights[k] = (all ? 1 : share) * (moments[k].weight + fit.prior.counts) / seen;
    if (!(moments[k].weight > 0)) continue;
    const double floor = fit.floors.empty() ? 0 : fit.floors[k];
    mixture.components[k] = {moments[k].mean(), map_covariance(moments[k], fit.prior, floor)};
  }
}

/// Returns the value that expectation-maximization raises with every step: the log likelihood of
/// the points, plus the log likelihood of the frozen moments (each under its own component), plus
/// the logarithm of the prior, up to a constant.
template <int D>
double objective(const GaussianMixture<D>& mixture, double log_likelihood,
                 const MixtureFit<D>& fit) {
  double value = log_likelihood;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const Gaussian<D>& g = mixture.components[k];
    const Moments<D> old = fit.frozen.empty() ? Moments<D>{} : fit.frozen[k];
    const Eigen::LLT<Matrix<D>> factor(g.covariance);
    const double log_determinant = 2 * Matrix<D>(factor.matrixL()).diagonal().array().log().sum();
    const Matrix<D> believed =
        old.scatter(g.mean) + fit.prior.strength * fit.prior.variance * Matrix<D>::Identity();
    const double counts = old.weight + fit.prior.counts;
    if (counts > 0) value += counts * std::log(mixture.weights[k]);
    value -= 0.5 * (old.weight + fit.prior.strength) * log_determinant;
    value -= 0.5 * factor.solve(believed).trace();
  }
  return value;
}

/// The result of a fit.
template <int D>
struct FitResult {
  std::vector<Moments<D>> seen;  ///< of the points alone, from the E step before the last M step
  int iterations = 0;
};

/// Fits a mixture to points, starting from its current state. The weights of the points count as
/// numbers of points.
template <int D>
FitResult<D> fit_mixture(GaussianMixture<D>& mixture, const WeightedPoints<D>& points,
                         const MixtureFit<D>& fit) {
  double weight = 0;
  for (std::size_t i = 0; i < points.size(); ++i) weight += points.weight(i);
  FitResult<D> result;
  double last = -std::numeric_limits<double>::infinity();
  while (result.iterations < fit.most_iterations) {
    Expectation<D> now = expectation(mixture, points);
    const double reached = objective(mixture, now.log_likelihood, fit);
    std::vector<Moments<D>> moments = now.moments;
    for (std::size_t k = 0; k < fit.frozen.size(); ++k) moments[k] += fit.frozen[k];
    maximize<D>(moments, fit, mixture);
    result.seen = std::move(now.moments);
    ++result.iterations;
    if (reached - last < fit.tolerance * weight) break;
    last = reached;
  }
  return result;
}

}  // namespace pharos::statistics

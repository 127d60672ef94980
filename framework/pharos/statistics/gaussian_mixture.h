#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
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
  static constexpr std::size_t kWidth = 8;

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
  /// Returns the eight points of register r; weights8() returns their weights.
  std::array<Double8, D> points8(std::size_t r) const {
    std::array<Double8, D> x;
    for (int axis = 0; axis < D; ++axis) x[axis] = load8(&values_[axis][r * kWidth]);
    return x;
  }
  Double8 weights8(std::size_t r) const { return load8(&values_[D][r * kWidth]); }

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
  /// The variance of the prior for each component, in place of prior.variance [unit^2]. Empty: it
  /// is the same for all.
  std::span<const double> prior_variances = {};
  /// The smallest eigenvalue of each component's covariance [unit^2]. Empty: no limit.
  std::span<const double> floors;
  /// The indices of the components that change. The other components keep their weights. Empty: all
  /// components change.
  std::span<const std::size_t> changing;
  int most_iterations = 100;  ///< at least 1
  /// The fit ends when a step raises objective() by less than this value per point. (A tolerance
  /// relative to objective() would depend on the unit of length.)
  double tolerance = 0.005;

  /// Returns the prior of component `k`.
  MixturePrior prior_of(std::size_t k) const {
    MixturePrior own = prior;
    if (!prior_variances.empty()) own.variance = prior_variances[k];
    return own;
  }
};

/// The result of an E step: the assignment of points to components, and the likelihood of the
/// points.
template <int D>
struct Expectation {
  std::vector<Moments<D>> moments;  ///< of the points of each component, weighted by responsibility
  double log_likelihood = 0;        ///< sum of w log p(x)
};

namespace detail {

/// Moments of eight streams of points, summed side by side.
template <int D>
struct Moments8 {
  Double8 weight{};
  std::array<Double8, D> first{};
  std::array<Double8, D*(D + 1) / 2> second{};

  void add(const Double8& w, const std::array<Double8, D>& x) {
    weight += w;
    for (int row = 0, i = 0; row < D; ++row) {
      const Double8 weighted = w * x[row];
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

/// Shares below e^-37 are lost when they are added to a share of 1.
inline constexpr double kLeastLogShare = -37;

/// Some components of a mixture, ready to be evaluated.
template <int D>
struct Terms {
  std::vector<std::size_t> components;
  std::vector<LogDensity<D>> densities;
  std::vector<double> log_weights;

  void add(const GaussianMixture<D>& mixture, std::size_t k) {
    components.push_back(k);
    densities.emplace_back(mixture.components[k]);
    log_weights.push_back(std::log(mixture.weights[k]));
  }
  std::size_t size() const { return components.size(); }
  /// Writes the logarithms of the weighted densities at eight points to `values`. Returns for each
  /// point the largest of these numbers, but not less than `least`.
  Double8 evaluate(const std::array<Double8, D>& x, Double8 least,
                   std::vector<Double8>& values) const {
    for (std::size_t i = 0; i < size(); ++i) {
      values[i] = densities[i](x) + log_weights[i];
      least = larger(least, values[i]);
    }
    return least;
  }
};

/// Returns the logarithm of zero in all lanes.
inline Double8 never8() {
  return all_doubles8(-std::numeric_limits<double>::infinity());
}

/// Computes the expectation over registers [begin, end) of the points. For each register, `rest`
/// holds the logarithm of the density of all other components. It is empty if there are no others.
template <int D>
Expectation<D> expectation_of_part(const Terms<D>& terms, std::size_t count,
                                   const WeightedPoints<D>& points, std::span<const Double8> rest,
                                   std::size_t begin, std::size_t end) {
  std::vector<Moments8<D>> moments(terms.size());
  std::vector<Double8> values(terms.size());
  std::vector<std::size_t> near(terms.size());  // components with a share in any of eight points
  Double8 log_likelihood{};
  for (std::size_t r = begin; r < end; ++r) {
    const std::array<Double8, D> x = points.points8(r);
    const Double8 w = points.weights8(r), others = rest.empty() ? never8() : rest[r];
    const Double8 largest = terms.evaluate(x, others, values);
    Double8 total = rest.empty() ? Double8{} : exp(others - largest);
    std::size_t near_count = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Double8 below = values[i] - largest;
      if (all_below(below, kLeastLogShare)) continue;
      values[i] = exp(below);
      total += values[i];
      near[near_count++] = i;
    }
    log_likelihood += w * (largest + log(total));
    const Double8 share = w / total;
    for (const std::size_t i : std::span(near).first(near_count)) {
      moments[i].add(share * values[i], x);
    }
  }
  Expectation<D> result{std::vector<Moments<D>>(count), sum(log_likelihood)};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    result.moments[terms.components[i]] = moments[i].summed();
  }
  return result;
}

inline constexpr std::size_t kRegistersAPart = 512;
/// Returns the number of parts that for_each_part() makes. It does not depend on the number of
/// threads.
inline std::size_t part_count(std::size_t registers) {
  return (registers + kRegistersAPart - 1) / kRegistersAPart;
}
/// Calls `compute(part, begin, end)` concurrently for all parts of the registers.
template <class Compute>
void for_each_part(std::size_t registers, Compute&& compute) {
  parallel_for(part_count(registers), [&](std::size_t part) {
    const std::size_t begin = part * kRegistersAPart;
    compute(part, begin, std::min(begin + kRegistersAPart, registers));
  });
}

/// Computes the E step for some of `count` components; see expectation_of_part() for `rest`. The
/// moments of all other components are zero.
template <int D>
Expectation<D> expectation_of(const Terms<D>& terms, std::size_t count,
                              const WeightedPoints<D>& points, std::span<const Double8> rest) {
  std::vector<Expectation<D>> parts(part_count(points.registers()));
  for_each_part(points.registers(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    parts[part] = expectation_of_part(terms, count, points, rest, begin, end);
  });
  Expectation<D> all{std::vector<Moments<D>>(count), 0};
  for (const Expectation<D>& part : parts) {
    for (std::size_t k = 0; k < count; ++k) all.moments[k] += part.moments[k];
    all.log_likelihood += part.log_likelihood;
  }
  return all;
}

/// Returns the logarithm of the summed density of these components for each register of points.
template <int D>
std::vector<Double8> log_sums(const Terms<D>& terms, const WeightedPoints<D>& points) {
  std::vector<Double8> sums(points.registers(), never8());
  if (terms.size() == 0) return sums;
  for_each_part(points.registers(), [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<Double8> values(terms.size());
    for (std::size_t r = begin; r < end; ++r) {
      const Double8 largest = terms.evaluate(points.points8(r), never8(), values);
      Double8 total{};
      for (const Double8& value : values) total += exp(value - largest);
      sums[r] = largest + log(total);
    }
  });
  return sums;
}

}  // namespace detail

/// Computes the E step by log-sum-exp, so no point is too far from all components. Parts of the
/// points run concurrently and are added in order, so the result is the same for any number of
/// threads.
template <int D>
Expectation<D> expectation(const GaussianMixture<D>& mixture, const WeightedPoints<D>& points) {
  detail::Terms<D> terms;
  for (std::size_t k = 0; k < mixture.size(); ++k) terms.add(mixture, k);
  return detail::expectation_of(terms, mixture.size(), points, {});
}

/// E steps of which only some components change from one to the next. The density of the others is
/// computed once for each point.
template <int D>
class MaskedExpectation {
 public:
  /// `points` and `changing` must outlive this object.
  MaskedExpectation(const GaussianMixture<D>& mixture, const WeightedPoints<D>& points,
                    std::span<const std::size_t> changing)
      : points_(points), changing_(changing) {
    detail::Terms<D> others;
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      if (std::find(changing.begin(), changing.end(), k) == changing.end()) others.add(mixture, k);
    }
    rest_ = detail::log_sums(others, points);
  }

  /// Returns expectation(), but with moments only for the components that change. All other
  /// components of `mixture` must be as they were.
  Expectation<D> operator()(const GaussianMixture<D>& mixture) const {
    detail::Terms<D> terms;
    for (const std::size_t k : changing_) terms.add(mixture, k);
    return detail::expectation_of(terms, mixture.size(), points_, rest_);
  }

 private:
  const WeightedPoints<D>& points_;
  std::span<const std::size_t> changing_;
  std::vector<Double8> rest_;
};

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
    mixture.components[k] = {moments[k].mean(), map_covariance(moments[k], fit.prior_of(k), floor)};
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
        old.scatter(g.mean) + fit.prior.strength * fit.prior_of(k).variance * Matrix<D>::Identity();
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
  std::optional<MaskedExpectation<D>> masked;
  if (!fit.changing.empty()) masked.emplace(mixture, points, fit.changing);
  FitResult<D> result;
  double last = -std::numeric_limits<double>::infinity();
  for (bool ends = false; !ends;) {
    Expectation<D> now = masked ? (*masked)(mixture) : expectation(mixture, points);
    const double reached = objective(mixture, now.log_likelihood, fit);
    ++result.iterations;
    ends = reached - last < fit.tolerance * weight || result.iterations >= fit.most_iterations;
    last = reached;
    if (ends && masked) now = expectation(mixture, points);
    std::vector<Moments<D>> moments = now.moments;
    for (std::size_t k = 0; k < fit.frozen.size(); ++k) moments[k] += fit.frozen[k];
    maximize<D>(moments, fit, mixture);
    result.seen = std::move(now.moments);
  }
  return result;
}

}  // namespace pharos::statistics

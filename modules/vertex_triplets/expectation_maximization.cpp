#include "expectation_maximization.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos::vertex_triplets {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Evaluates the logarithm of a weighted Gaussian for registers of points.
template <int D>
struct Term {
  Term(double weight, const Gaussian<D>& gaussian) {
    const Eigen::LLT<Matrix<D>> factor(gaussian.covariance);
    const Matrix<D> inverse = factor.matrixL().solve(Matrix<D>::Identity());
    for (int row = 0, i = 0; row < D; ++row) {
      mean[row] = static_cast<float>(gaussian.mean[row]);
      for (int column = 0; column <= row; ++column) {
        whitening[i++] = static_cast<float>(inverse(row, column));
      }
    }
    constant = static_cast<float>(std::log(weight) + inverse.diagonal().array().log().sum() -
                                  0.5 * D * std::log(2 * EIGEN_PI));
  }

  std::array<Float8, D> offset(const std::array<Float8, D>& x) const {
    std::array<Float8, D> d;
    for (int axis = 0; axis < D; ++axis) d[axis] = x[axis] - mean[axis];
    return d;
  }
  Float8 operator()(const std::array<Float8, D>& d) const {
    Float8 squared{};
    for (int row = 0, i = 0; row < D; ++row) {
      Float8 white = d[0] * whitening[i++];
      for (int column = 1; column <= row; ++column) white += d[column] * whitening[i++];
      squared += white * white;
    }
    return constant - 0.5f * squared;
  }

  std::array<float, D> mean;
  std::array<float, Sums<D>::kPairs> whitening;
  float constant;
};

template <int D>
std::vector<Term<D>> terms_of(const Mixture<D>& mixture) {
  std::vector<Term<D>> terms;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    terms.emplace_back(mixture.weights[k], mixture.components[k]);
  }
  return terms;
}

/// Number of registers that are processed together, so that their terms stay in the L1 cache.
constexpr std::size_t kBlock = 8;

/// Returns the mean logarithm of the density over points and believed points.
template <int D>
double log_likelihood_with(const Beliefs<D>& beliefs, const Mixture<D>& mixture,
                           const Expectation<D>& found) {
  if (beliefs.empty()) return found.log_likelihood;
  double weight = 0;
  for (const Sums<D>& sums : found.sums) weight += sums.weight;
  return (weight * found.log_likelihood + log_prior(mixture, beliefs)) /
         (weight + weight_of<D>(beliefs));
}

}  // namespace

template <int D>
Expectation<D> expectation(const Mixture<D>& mixture, const Points<D>& points) {
  const std::vector<Term<D>> terms = terms_of(mixture);
  std::vector<Sums8<D>> sums(terms.size());
  std::vector<std::array<Float8, kBlock>> shares(terms.size());
  double log_likelihood = 0, weight = 0;
  const auto& registers = points.registers();
  for (std::size_t begin = 0; begin < registers.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, registers.size() - begin);
    std::array<Float8, kBlock> largest, total{};
    largest.fill(all8(-kInfinite));
    for (std::size_t k = 0; k < terms.size(); ++k) {
      for (std::size_t r = 0; r < count; ++r) {
        shares[k][r] = terms[k](terms[k].offset(registers[begin + r].x));
        largest[r] = larger(largest[r], shares[k][r]);
      }
    }
    for (std::size_t k = 0; k < terms.size(); ++k) {
      for (std::size_t r = 0; r < count; ++r) {
        // Responsibilities below 2e-9 of the largest are set to zero: most components contribute
        // nothing to most points.
        constexpr float kLeast = -20;
        const Float8 below = shares[k][r] - largest[r];
        shares[k][r] = below < kLeast ? Float8{} : exp(below);
        total[r] += shares[k][r];
      }
    }
    for (std::size_t r = 0; r < count; ++r) {
      const Float8& w = registers[begin + r].weight;
      for (int i = 0; i < 8; ++i) {
        if (!(w[i] > 0)) continue;
        weight += w[i];
        log_likelihood += double{w[i]} * (largest[r][i] + std::log(total[r][i]));
      }
      total[r] = w / total[r];
    }
    for (std::size_t k = 0; k < terms.size(); ++k) {
      for (std::size_t r = 0; r < count; ++r) {
        const Float8 v = shares[k][r] * total[r];
        if (any(v > 0)) sums[k].add(v, terms[k].offset(registers[begin + r].x));
      }
    }
  }
  Expectation<D> result{.log_likelihood = log_likelihood / weight};
  for (const Sums8<D>& s : sums) result.sums.push_back(s.summed());
  return result;
}

template <int D>
Mixture<D> maximization(const Mixture<D>& mixture, const Expectation<D>& expectation,
                        const Regularization& rule, const Beliefs<D>& beliefs) {
  double total = weight_of<D>(beliefs);
  for (const Sums<D>& sums : expectation.sums) total += sums.weight;
  Mixture<D> next;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const Sums<D>& sums = expectation.sums[k];
    const Belief<D> belief = belief_in(beliefs, k);
    const bool has_points = sums.weight > 0 && sums.squared_weight > 0;
    if (!has_points && !(belief.weight > 0)) continue;
    next.weights.push_back((sums.weight + belief.weight) / total);
    next.components.push_back(most_probable(sums, mixture.components[k].mean, belief, rule));
  }
  return next;
}

template <int D>
Fit<D> fit(const Mixture<D>& start, const Points<D>& points, const FitSettings& settings,
           const Beliefs<D>& beliefs) {
  Fit<D> best{.log_likelihood = -std::numeric_limits<double>::infinity()};
  Mixture<D> mixture = start;
  double last = 0;
  for (int iteration = 0; iteration < settings.most_iterations; ++iteration) {
    const Expectation<D> found = expectation(mixture, points);
    const double reached = log_likelihood_with(beliefs, mixture, found);
    best.iterations = iteration + 1;
    if (reached > best.log_likelihood) {
      best.mixture = mixture;
      best.log_likelihood = reached;
    }
    constexpr double kLeast = 1e-12;
    const double change = std::abs(reached - last);
    if (iteration > 0 && !(change >= settings.tolerance * std::max(std::abs(last), kLeast))) break;
    last = reached;
    mixture = maximization(mixture, found, settings.regularization, beliefs);
  }
  return best;
}

template <int D>
std::vector<std::size_t> assignment(const Mixture<D>& mixture, const Points<D>& points) {
  const std::vector<Term<D>> terms = terms_of(mixture);
  std::vector<std::size_t> result(points.size(), 0);
  for (std::size_t r = 0; r < points.registers().size(); ++r) {
    Float8 largest = all8(-kInfinite);
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const Float8 term = terms[k](terms[k].offset(points.registers()[r].x));
      for (std::size_t i = 0; i < std::min<std::size_t>(8, points.size() - 8 * r); ++i) {
        if (term[i] > largest[i]) result[8 * r + i] = k;
      }
      largest = larger(largest, term);
    }
  }
  return result;
}

// Instances for mixtures at the camera, of pairs and of triplets.
#define PHAROS_FOR_DIMENSION(D)                                                   \
  template Expectation<D> expectation<D>(const Mixture<D>&, const Points<D>&);    \
  template Mixture<D> maximization<D>(const Mixture<D>&, const Expectation<D>&,   \
                                      const Regularization&, const Beliefs<D>&);  \
  template Fit<D> fit<D>(const Mixture<D>&, const Points<D>&, const FitSettings&, \
                         const Beliefs<D>&);                                      \
  template std::vector<std::size_t> assignment<D>(const Mixture<D>&, const Points<D>&);
PHAROS_FOR_DIMENSION(3)
PHAROS_FOR_DIMENSION(6)
PHAROS_FOR_DIMENSION(9)
#undef PHAROS_FOR_DIMENSION

}  // namespace pharos::vertex_triplets

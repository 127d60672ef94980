#pragma once

#include <cmath>
#include <vector>

#include <pharos/statistics/gaussian_mixture.h>

#include "covariance.h"
#include "points.h"

/// Prior knowledge of a mixture. Fits find the most probable mixture given this knowledge and the
/// points (maximum a posteriori). A belief counts like points, the *believed points*.
namespace pharos::vertex_triplets {

template <int D>
using Mixture = statistics::GaussianMixture<D>;

/// The belief in a component: that points of this weight have the mean and the covariance of this
/// Gaussian.
template <int D>
struct Belief {
  double weight = 0;  ///< in the unit of the points' weights; 0: nothing is believed
  Gaussian<D> gaussian;
};

/// The beliefs in the first components of a mixture. Nothing is believed of the other components.
template <int D>
using Beliefs = std::vector<Belief<D>>;

/// Returns the belief in component `k`.
template <int D>
Belief<D> belief_in(const Beliefs<D>& beliefs, std::size_t k) {
  return k < beliefs.size() ? beliefs[k] : Belief<D>{};
}

/// Returns the Gaussian of a component, given the sums about `origin` over its points and the
/// belief. Without points, it is the believed Gaussian. Without belief, it is the Gaussian of the
/// points with the regularized covariance. Otherwise, it has the mean and the covariance of all
/// points together, real and believed ones. In this case, the regularization draws the
/// covariance to the believed one (in place of Sigma_reg in eq. 39): the few points that need
/// regularization know less of the covariance than the belief does. Requires points or a belief.
template <int D>
Gaussian<D> most_probable(const Sums<D>& sums, const Vector<D>& origin, const Belief<D>& belief,
                          const Regularization& rule) {
  if (!(sums.weight > 0) || !(sums.squared_weight > 0)) return belief.gaussian;
  const Vector<D> mean = origin + sums.offset();
  if (!(belief.weight > 0)) {
    return {mean, regularized<D>(sums.covariance(), sums.count(), rule)};
  }
  const Gaussian<D>& believed = belief.gaussian;
  const double share = sums.weight / (sums.weight + belief.weight);
  const Vector<D> apart = mean - believed.mean;
  const Matrix<D> together = share * sums.covariance() + (1 - share) * believed.covariance +
                             share * (1 - share) * apart * apart.transpose();
  const double of_sample = rule.is_on ? share_of_sample<D>(sums.count()) : 1;
  return {believed.mean + share * apart,
          statistics::with_eigenvalues_above<D>(
              rule.least_deviation * rule.least_deviation,
              of_sample * together + (1 - of_sample) * believed.covariance)};
}

/// Returns the mean logarithm of the density over the believed points, each under its component,
/// times their weight. Up to a constant, this is the logarithm of the prior density of the mixture:
/// Dirichlet for its weights, and normal inverse Wishart for its components.
template <int D>
double log_prior(const Mixture<D>& mixture, const Beliefs<D>& beliefs) {
  double sum = 0;
  for (std::size_t k = 0; k < beliefs.size(); ++k) {
    const Gaussian<D>& believed = beliefs[k].gaussian;
    const Vector<D> apart = believed.mean - mixture.components[k].mean;
    const Matrix<D> about_mean = believed.covariance + apart * apart.transpose();
    sum += beliefs[k].weight * (std::log(mixture.weights[k]) +
                                mean_log_density<D>(about_mean, mixture.components[k].covariance));
  }
  return sum;
}

/// Returns the sum of the weights of believed points.
template <int D>
double weight_of(const Beliefs<D>& beliefs) {
  double sum = 0;
  for (const Belief<D>& belief : beliefs) sum += belief.weight;
  return sum;
}

/// Returns the mixture without any points. Requires a belief.
template <int D>
Mixture<D> believed_mixture(const Beliefs<D>& beliefs) {
  Mixture<D> mixture;
  for (const Belief<D>& belief : beliefs) {
    mixture.weights.push_back(belief.weight / weight_of<D>(beliefs));
    mixture.components.push_back(belief.gaussian);
  }
  return mixture;
}

}  // namespace pharos::vertex_triplets

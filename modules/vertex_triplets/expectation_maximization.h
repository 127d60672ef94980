#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "belief.h"
#include "points.h"

/// Expectation-maximization of mixtures of Gaussians with weighted points (Schuessler et al. 2022,
/// section 6.2). It uses single precision, because points are near the origin, in units of their
/// cell.
namespace pharos::vertex_triplets {

struct FitSettings {
  Regularization regularization;
  int most_iterations = 50;
  /// The fit ends when the mean logarithm of the density changes by less, relative to itself (eq.
  /// 38).
  double tolerance = 1e-3;
};

/// The result of an E step.
template <int D>
struct Expectation {
  double log_likelihood = 0;  ///< sum of w log p(x) over the sum of w
  std::vector<Sums<D>> sums;  ///< for each component about its mean, with v = w r (eq. 36)
};

/// The E step (eq. 36).
template <int D>
Expectation<D> expectation(const Mixture<D>& mixture, const Points<D>& points);

/// The M step (eq. 37 with covariances about the new means; eq. 39), given beliefs in the first
/// components. Components without points and belief are left out.
template <int D>
Mixture<D> maximization(const Mixture<D>& mixture, const Expectation<D>& expectation,
                        const Regularization& rule, const Beliefs<D>& beliefs = {});

/// The result of fit().
template <int D>
struct Fit {
  Mixture<D> mixture;
  double log_likelihood = 0;  ///< as in Expectation, but over points and believed points
  int iterations = 0;
};

/// Alternates both steps, beginning with `start`, and returns the mixture with the highest
/// likelihood on the way: with regularization a step may lower the likelihood. The likelihood is
/// the one of points and believed points.
template <int D>
Fit<D> fit(const Mixture<D>& start, const Points<D>& points, const FitSettings& settings,
           const Beliefs<D>& beliefs = {});

/// Returns for each point the most likely component.
template <int D>
std::vector<std::size_t> assignment(const Mixture<D>& mixture, const Points<D>& points);

}  // namespace pharos::vertex_triplets

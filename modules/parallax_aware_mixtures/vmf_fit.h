#pragma once

#include <span>
#include <vector>

#include <pharos/core/vec.h>
#include <pharos/statistics/gaussian.h>

/// Mixtures of von Mises-Fisher distributions, and their fit to weighted directions by maximum a
/// posteriori expectation-maximization (Ruppert et al. 2020, section 4 and supplemental).
namespace pharos::parallax_aware_mixtures {

using Direction = statistics::Vector<3>;

/// A component of a mixture.
struct Lobe {
  double weight = 0;
  Direction mean = Direction::UnitZ();
  double kappa = 0;
  void archive(Archive& archive) { archive(weight, mean, kappa); }
};
using Mixture = std::vector<Lobe>;

/// The sufficient statistics of a lobe: sums over directions, weighted by responsibility.
struct Moments {
  double weight = 0;
  Direction resultant = Direction::Zero();

  void archive(Archive& archive) { archive(weight, resultant); }
  Moments& operator+=(const Moments& other) {
    weight += other.weight;
    resultant += other.resultant;
    return *this;
  }
  Moments& operator*=(double factor) {
    weight *= factor;
    resultant *= factor;
    return *this;
  }
};

/// A unit direction with a weight >= 0, which acts as a number of directions.
struct WeightedDirection {
  Vec3 direction;
  float weight = 0;
};

/// The rules of a fit: its fixed statistics, its priors, and when it ends.
struct FitRules {
  /// Moments of earlier directions, one for each lobe, which stay fixed. Empty: there are none.
  std::span<const Moments> frozen;
  double prior_share = 0.01;    ///< prior weight of each lobe, over the weight of all directions
  double prior_strength = 0.2;  ///< prior weight of directions whose resultant is zero, per lobe
  double most_kappa = 32768;
  std::span<const std::size_t> changing;  ///< lobes that the fit may change; empty: all
  int most_iterations = 100;
  double tolerance = 0.005;  ///< the fit ends when a step raises the mean of objective() by less
};

/// The result of an E step.
struct Expectation {
  std::vector<Moments> moments;
  double log_likelihood = 0;  ///< sum of w log p
};

/// The E step, by log-sum-exp. Parts of the directions run concurrently and are added in order, so
/// the result is the same for any number of threads.
Expectation expectation(const Mixture& mixture, std::span<const WeightedDirection> directions);

/// The M step: sets the lobes to the most probable ones for these moments. It does not add
/// rules.frozen. Lobes whose moments are zero keep their mean and concentration.
void maximize(std::span<const Moments> moments, const FitRules& rules, Mixture& mixture);

/// Returns the objective, which expectation-maximization raises with every step. It is the
/// log-likelihood of the directions, plus the log-likelihood of the frozen moments (each with its
/// own lobe), plus the logarithm of the prior, up to a constant. `seen` is the weight of all
/// directions and frozen moments.
double objective(const Mixture& mixture, double log_likelihood, double seen, const FitRules& rules);

/// Fits a mixture to directions, starting with its current lobes. A weight acts as a number of
/// directions. Returns the moments of the directions alone, from the last E step.
std::vector<Moments> fit(Mixture& mixture, std::span<const WeightedDirection> directions,
                         const FitRules& rules);

}  // namespace pharos::parallax_aware_mixtures

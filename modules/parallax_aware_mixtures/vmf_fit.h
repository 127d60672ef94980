#pragma once

#include <span>
#include <vector>

#include <pharos/core/vec.h>
#include <pharos/statistics/gaussian.h>

/// Mixtures of von Mises-Fisher distributions and their fit to weighted directions by maximum a
/// posteriori expectation-maximization (Ruppert et al. 2020, section 4; supplemental).
namespace pharos::parallax_aware_mixtures {

using Direction = statistics::Vector<3>;

/// A component of a mixture.
struct Lobe {
  double weight = 0;
  Direction mean = Direction::UnitZ();
  double kappa = 0;
};
using Mixture = std::vector<Lobe>;

/// What a lobe follows from: sums over directions, weighted by responsibility.
struct Moments {
  double weight = 0;
  Direction resultant = Direction::Zero();

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

/// A unit direction that counts `weight` >= 0 times.
struct WeightedDirection {
  Vec3 direction;
  float weight = 0;
};

/// A fit: what stays, what is believed, and when it ends.
struct FitRules {
  /// Moments of what was seen before, one for each lobe; they count as they are. Empty: none.
  std::span<const Moments> frozen;
  double prior_share = 0.01;    ///< of all that was seen: what every lobe is believed to have seen
  double prior_strength = 0.2;  ///< directions without any preference that each lobe has seen
  double most_kappa = 32768;
  std::span<const std::size_t> changing;  ///< lobes that are to change; empty: all
  int most_iterations = 100;
  double tolerance = 0.005;  ///< ends when a step raises the mean of objective() by less
};

/// What a mixture makes of directions.
struct Expectation {
  std::vector<Moments> moments;
  double log_likelihood = 0;  ///< sum of w log p
};

/// The E step, by log-sum-exp. Parts of the directions run concurrently and are added in order:
/// the same for any number of threads.
Expectation expectation(const Mixture& mixture, std::span<const WeightedDirection> directions);

/// The M step: the most probable lobes for these moments, rules.frozen not added. Lobes without
/// weight stay where they are.
void maximize(std::span<const Moments> moments, const FitRules& rules, Mixture& mixture);

/// What expectation-maximization raises with every step: the logarithm of the directions'
/// likelihood, of the frozen moments' (each with its own lobe), and of the prior, up to a constant.
/// `seen` is the weight of all directions and frozen moments.
double objective(const Mixture& mixture, double log_likelihood, double seen, const FitRules& rules);

/// Fits a mixture to directions, from where it stands; their weights count as numbers. Returns the
/// moments of the directions alone, by the last E step before the last M step.
std::vector<Moments> fit(Mixture& mixture, std::span<const WeightedDirection> directions,
                         const FitRules& rules);

}  // namespace pharos::parallax_aware_mixtures

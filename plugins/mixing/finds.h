#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>

namespace pharos {

/// What makes a share of unguided samples a good one (see learned.cpp).
enum class MixingObjective {
  kl,       ///< least Kullback-Leibler divergence of the mixture from what is sought
  variance  ///< least variance of what a step finds
};

/// What all steps of one iteration from one region found, in a form that adds up and that tells the
/// objective of every share.
///
/// Within an iteration a region's share a0 is frozen. All that matters of a step of densities B
/// (unguided) and G (guided) is then
///
///     x = f / p            what it found, with p = a0 B + (1 - a0) G,
///     u = a0 B / p         the probability that it was drawn unguided:
///
/// under another share a its density would be q p, with q = a/a0 u + (1 - a)/(1 - a0) (1 - u).
/// Steps are kept as a histogram over u, finer towards both ends: of each bin the sum of weights (x
/// or x^2, by objective) and the weighted mean of u.
class Finds {
 public:
  /// One bin, in terms of densities relative to p.
  struct Term {
    double weight = 0;              ///< share of all weights; they sum to 1
    double guided = 0, excess = 0;  ///< G / p and (B - G) / p: q is guided + a excess
  };

  explicit Finds(std::uint32_t bins) : bins_(bins) {}

  /// A step of weight `weight` >= 0 and of `u` in [0, 1].
  void add(double u, double weight);

  /// Number of steps, those of weight zero included.
  std::uint64_t steps() const { return steps_; }
  /// The bins that hold anything, for steps drawn with a share `drawn_with` in (0, 1).
  std::vector<Term> terms(double drawn_with) const;

  /// Loads what was saved with as many bins.
  void archive(Archive& archive);

 private:
  struct Bin {
    double weight = 0;  ///< sum of weights
    double moment = 0;  ///< sum of weights times u
    void archive(Archive& archive) { archive(weight, moment); }
  };

  std::vector<Bin> bins_;
  std::uint64_t steps_ = 0;
};

/// The derivative of the objective with respect to the share, at a share `a` in (0, 1):
/// kl minimizes the mean of -log q, variance that of 1 / q.
double objective_slope(const std::vector<Finds::Term>& terms, double a, MixingObjective objective);

}  // namespace pharos

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/archive.h>

namespace pharos {

/// The objective that the best share of unguided samples minimizes (see learned.cpp).
enum class MixingObjective {
  kl,       ///< Kullback-Leibler divergence of the mixture from the target distribution
  variance  ///< variance of the estimate of a step
};

template <>
struct EnumNames<MixingObjective> {
  static constexpr auto names = std::to_array<EnumName<MixingObjective>>(
      {{"kl", MixingObjective::kl}, {"variance", MixingObjective::variance}});
};

/// A summary of all steps of one iteration from one region. Summaries add up, and the objective of
/// every share can be computed from them.
///
/// Within an iteration, the share a0 of a region is frozen. A step has the densities B (unguided)
/// and G (guided). Only two quantities of the step matter:
///
///     x = f / p            its estimate, with p = a0 B + (1 - a0) G,
///     u = a0 B / p         the probability that it was drawn unguided.
///
/// Under another share a, the density of the step would be q p, with
///
///     q = a/a0 u + (1 - a)/(1 - a0) (1 - u).
///
/// Steps are kept as a histogram over u that is finer towards both ends. Each bin holds
/// the sum of weights (x or x^2, by objective) and the sum of weights times u.
class Finds {
 public:
  /// A bin in terms of densities relative to p.
  struct Term {
    double weight = 0;              ///< share of all weights; they sum to 1
    double guided = 0, excess = 0;  ///< G / p and (B - G) / p: q is guided + a excess
  };

  explicit Finds(std::uint32_t bins) : bins_(bins) {}

  /// Adds a step of weight `weight` >= 0 and of `u` in [0, 1].
  void add(double u, double weight);

  /// Returns the number of steps, including steps of weight zero.
  std::uint64_t steps() const { return steps_; }
  /// Returns the bins that are not empty, for steps drawn with a share `drawn_with` in (0, 1).
  std::vector<Term> terms(double drawn_with) const;

  /// Saves the summary, or loads one that has the same number of bins.
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

/// Returns the derivative of the objective with respect to the share, at a share `a` in (0, 1). The
/// objective is the mean of -log q for kl, and the mean of 1 / q for variance.
double objective_slope(const std::vector<Finds::Term>& terms, double a, MixingObjective objective);

}  // namespace pharos

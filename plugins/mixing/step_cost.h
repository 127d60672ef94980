#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <pharos/core/archive.h>
#include <pharos/guiding/pipeline/guiding_settings.h>

#include "finds.h"

namespace pharos {

/// The largest number of sampling techniques: unguided sampling and all methods.
inline constexpr std::size_t kMostTechniques = GuidingSettings::kMostMethods + 1;

/// The shares of the techniques. They are >= 0 and sum to 1; [0] is unguided sampling.
using Simplex = std::array<double, kMostTechniques>;

/// Marks some of the techniques.
using TechniqueSet = std::array<bool, kMostTechniques>;

/// A step that found light, as the shares see it.
struct FoundStep {
  double weight = 0;  ///< the estimate x of the step (kl), or its square (variance)
  /// Density of each technique, relative to the density with which the step was drawn.
  std::array<float, kMostTechniques> ratios{};
  void archive(Archive& archive) { archive(weight, ratios); }
};

/// Scales numbers >= 0 so that they sum to 1.
Simplex normalized(Simplex numbers);

/// Returns what the steps would cost under other shares, relative to the shares with which they
/// were drawn. q is the density of a step under `shares`, relative to the density with which it was
/// drawn.
///
///     variance: sum of w / q, over sum of w, with weights w = x^2: the second moment of the
///               estimates x
///     kl:       e^(-(sum of w log q, over sum of w)), with weights w = x: the exponential of the
///               Kullback-Leibler divergence from the target distribution, up to a factor
///
/// Every function considers the first `count` techniques.
double cost_of(std::span<const FoundStep> steps, const Simplex& shares, std::size_t count,
               MixingObjective objective);

/// Returns the shares that minimize cost_of(). Techniques with `allowed[i]` false get the share 0.
/// At least one technique must be allowed. Both objectives are convex functions of the shares. The
/// multiplicative algorithm lowers them in every step: with exponent 1/2 the second moment (Yu
/// 2010, "Monotonic Convergence of a General Algorithm for Computing Optimal Designs"), and with
/// exponent 1 the divergence, where it is expectation-maximization.
Simplex least_cost(std::span<const FoundStep> steps, const TechniqueSet& allowed, std::size_t count,
                   MixingObjective objective);

/// Raises the share of unguided sampling to at least `least`; the other techniques divide the rest
/// as before.
Simplex with_least_unguided(Simplex shares, double least, std::size_t count);

}  // namespace pharos

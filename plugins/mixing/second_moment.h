#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <pharos/core/archive.h>
#include <pharos/guiding/pipeline/guiding_settings.h>

namespace pharos {

/// The largest number of sampling techniques: unguided sampling and all methods.
inline constexpr std::size_t kMostTechniques = GuidingSettings::kMostMethods + 1;

/// The shares of the techniques. They are >= 0 and sum to 1; [0] is unguided sampling.
using Simplex = std::array<double, kMostTechniques>;

/// A step that found light, as the shares see it.
struct FoundStep {
  double weight = 0;  ///< squared estimate of the step
  /// Density of each technique, relative to the density with which the step was drawn.
  std::array<float, kMostTechniques> ratios{};
  void archive(Archive& archive) { archive(weight, ratios); }
};

/// Scales numbers >= 0 so that they sum to 1.
Simplex normalized(Simplex numbers);

/// The sum of weight / q over steps, where q is the density of a step under some shares, relative
/// to the density with which it was drawn. If the weights are squared estimates f^2 / p^2, this is
/// an estimate of the second moment that the estimates would have under these shares.
///
/// Every function considers the first `count` techniques.
double second_moment(std::span<const FoundStep> steps, const Simplex& shares, std::size_t count);

/// Returns the shares that minimize second_moment(). Techniques with `allowed[i]` false get the
/// share 0. At least one technique must be allowed. The objective is convex. The multiplicative
/// algorithm with exponent 1/2 lowers it in every step (Yu 2010, "Monotonic Convergence of a
/// General Algorithm for Computing Optimal Designs").
Simplex least_second_moment(std::span<const FoundStep> steps,
                            const std::array<bool, kMostTechniques>& allowed, std::size_t count);

/// Raises the share of unguided sampling to at least `least`; the other techniques divide the rest
/// as before.
Simplex with_least_unguided(Simplex shares, double least, std::size_t count);

}  // namespace pharos

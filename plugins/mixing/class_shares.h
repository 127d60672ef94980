#pragma once

#include <cstddef>

#include <pharos/core/archive.h>
#include <pharos/core/random.h>
#include <pharos/statistics/varopt.h>

#include "simplex.h"
#include "step_cost.h"

namespace pharos {

/// The shares of the techniques for training iterations and for the final one.
struct StagedShares {
  Simplex training{}, final{};
  bool found_light = false;  ///< the shares were learned, and not only assumed
  void archive(Archive& archive) { archive(training, final, found_light); }
};

/// The shares of the techniques at vertices of one class, learned from iteration to iteration. Only
/// a weighted reservoir of the steps of the current iteration is kept.
class ClassShares {
 public:
  /// Makes an object that is to be loaded.
  ClassShares() = default;
  /// Makes an object that has the shares `prior` until it learns. Copies learn independently.
  ClassShares(const StagedShares& prior, const SimplexMixing::Settings& settings);

  void add(const FoundStep& step, RandomStream& random);
  /// Drops the steps of the current iteration. What was learned before stays.
  void drop_steps();
  /// Ends an iteration: learns from its steps, for the first `count` techniques. `prior` counts
  /// like `settings.prior_steps` steps beside all that were seen so far. Techniques that are not in
  /// use have no share any more.
  void learn(const SimplexMixing::Settings& settings, std::size_t count, const TechniqueSet& in_use,
             const StagedShares& prior);

  /// Returns the shares for the next iteration. In the final iteration, methods that are surely not
  /// worth their cost have the share 0. A class that has found no light yet has the shares of its
  /// prior.
  const StagedShares& shares() const { return shares_; }

  void archive(Archive& archive);

 private:
  StagedShares shares_;   ///< of this class and its prior
  StagedShares own_;      ///< of the steps of this class alone; zero before light was found
  double certainty_ = 0;  ///< number of steps that `own_` is worth
  statistics::VarOptReservoir<FoundStep> steps_{1};
  double weights_ = 0, squares_ = 0;  ///< sums over all steps of the iteration
};

}  // namespace pharos

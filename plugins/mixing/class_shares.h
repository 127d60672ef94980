#pragma once

#include <cstddef>

#include <pharos/core/archive.h>
#include <pharos/core/random.h>
#include <pharos/statistics/varopt.h>

#include "simplex.h"
#include "step_cost.h"

namespace pharos {

/// The shares of the techniques at vertices of one class, learned from iteration to iteration. Only
/// a weighted reservoir of the steps of the current iteration is kept.
class ClassShares {
 public:
  /// Makes an object that is to be loaded.
  ClassShares() = default;
  /// `prior` holds the shares before any step is seen, as if from `settings.prior_steps` steps.
  /// Copies of a class learn independently.
  ClassShares(const Simplex& prior, const SimplexMixing::Settings& settings);

  void add(const FoundStep& step, RandomStream& random);
  /// Drops the steps of the current iteration. What was learned before stays.
  void drop_steps();
  /// Ends an iteration: learns from its steps, for the first `count` techniques.
  void learn(const SimplexMixing::Settings& settings, std::size_t count);

  /// Returns the shares for the next training iteration.
  const Simplex& shares() const { return shares_; }
  /// Returns the shares for the final iteration. Methods that are not worth their cost have the
  /// share 0, and so have all methods until light has been found.
  const Simplex& final_shares() const { return final_shares_; }

  void archive(Archive& archive);

 private:
  Simplex shares_{}, final_shares_{};
  double certainty_ = 0;  ///< number of steps that the shares are worth
  statistics::VarOptReservoir<FoundStep> steps_{1};
  double weights_ = 0, squares_ = 0;  ///< sums over all steps of the iteration
};

}  // namespace pharos

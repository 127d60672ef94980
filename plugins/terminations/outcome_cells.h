#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/guiding/toolkit/kd_tree_cells.h>

#include "step_outcomes.h"

namespace pharos {

/// Sums over outcomes, each times the number of steps for which it counts.
struct OutcomeSums {
  double steps = 0, radiance = 0, squared = 0, cost = 0;
  double limited = 0, limited_squared = 0;  ///< of StepOutcome::limited and its square

  void add(const StepOutcome& outcome) {
    const double count = outcome.steps;
    steps += count;
    radiance += count * outcome.radiance;
    squared += count * outcome.radiance * outcome.radiance;
    cost += count * outcome.cost;
    limited += count * outcome.limited;
    limited_squared += count * outcome.limited * outcome.limited;
  }
  OutcomeSums& operator+=(const OutcomeSums& other);
  void scale(double factor);
  void archive(Archive& archive);
};

/// Expected values over the steps from a vertex.
struct ExpectedOutcome {
  float radiance = 0;  ///< outgoing radiance, without what the vertex itself emits
  float squared = 0;   ///< second moment of the estimates of `radiance`
  float variance = 0;  ///< of the limited estimates (StepOutcome::limited)
  float cost = 1;      ///< steps and light samples that a step leads to, itself included

  void archive(Archive& archive) { archive(radiance, squared, variance, cost); }
};

/// Bins of directions: `rows` rows of equal height along z, each of as many bins around z. 4 x 4
/// bins have equal solid angles.
class DirectionBins {
 public:
  explicit DirectionBins(std::uint32_t rows) : rows_(rows) {}
  std::size_t count() const { return std::size_t{rows_} * rows_; }
  /// Returns the bin of a unit direction.
  std::size_t at(Vec3 direction) const;

 private:
  std::uint32_t rows_;
};

/// What was found in a cell of space, by direction towards the viewer. A cell of KdTreeCells.
struct OutcomeCell {
  std::vector<OutcomeSums> bins;  ///< empty: nothing was found yet

  bool knows_something() const { return !bins.empty(); }
  void forget(double factor);
  void learn(std::span<const StepOutcome> outcomes, const DirectionBins& directions);
  void archive(Archive& archive) { archive(bins); }
};

using OutcomeCells = KdTreeCells<StepOutcome, OutcomeCell>;

/// What steps are expected to find, by position and direction: constant and thread-safe.
class OutcomeField {
 public:
  /// Knows nothing; for loading.
  explicit OutcomeField(DirectionBins directions) : directions_(directions) {}
  /// Takes the means of what `cells` have found. The mean of the same bin of the next larger cell
  /// is added to the steps of a bin, as if it came from `least_steps` further steps. This larger
  /// cell is made of all cells below the plane that has made the cell, and so on up to the whole
  /// scene.
  OutcomeField(const OutcomeCells& cells, DirectionBins directions, double least_steps);

  /// Returns what steps from a point find if the viewer is in this unit direction.
  const ExpectedOutcome& at(Point3 p, Vec3 towards_viewer) const {
    return expected_[tree_.cell_at(p) * directions_.count() + directions_.at(towards_viewer)];
  }
  void archive(Archive& archive);

 private:
  KdTree tree_;
  DirectionBins directions_;
  std::vector<ExpectedOutcome> expected_;
};

}  // namespace pharos

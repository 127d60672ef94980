#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/guiding/toolkit/kd_tree_cells.h>

#include "outcome_reader.h"

namespace pharos {

/// Sums over outcomes of one kind, each times the number for which it counts.
struct OutcomeMoments {
  double count = 0, radiance = 0, squared = 0, cost = 0;
  double limited = 0, limited_squared = 0;  ///< of Outcome::limited and its square

  void add(const Outcome& outcome) {
    const double n = outcome.count;
    count += n;
    radiance += n * outcome.radiance;
    squared += n * outcome.radiance * outcome.radiance;
    cost += n * outcome.cost;
    limited += n * outcome.limited;
    limited_squared += n * outcome.limited * outcome.limited;
  }
  OutcomeMoments& operator+=(const OutcomeMoments& other);
  void scale(double factor);
  void archive(Archive& archive);
};

/// Sums over the outcomes of steps and of light samples.
struct OutcomeSums {
  OutcomeMoments steps, lights;

  void add(const Outcome& outcome) { (outcome.of_light ? lights : steps).add(outcome); }
  OutcomeSums& operator+=(const OutcomeSums& other);
  void scale(double factor);
  void archive(Archive& archive) { archive(steps, lights); }
};

/// The spread of estimates X, each of which takes C steps and light samples. The best number of
/// estimates is in proportion to it.
struct Spread {
  /// sqrt(E[X^2] / C), for roulette [radiance per square root of a step].
  float squared = 0;
  /// sqrt(V[X] / C) of the limited estimates (Outcome::limited), for splitting [the same].
  float variance = 0;

  void archive(Archive& archive) { archive(squared, variance); }
};

/// Expected values at a vertex.
struct ExpectedOutcome {
  float radiance = 0;  ///< outgoing radiance, without what the vertex itself emits
  Spread step, light;  ///< of the estimates of a step, and of a light sample

  void archive(Archive& archive) { archive(radiance, step, light); }
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
  void learn(std::span<const Outcome> outcomes, const DirectionBins& directions);
  void archive(Archive& archive) { archive(bins); }
};

using OutcomeCells = KdTreeCells<Outcome, OutcomeCell>;

/// Expected values by the position of a vertex and the direction towards the viewer: constant and
/// thread-safe.
class OutcomeField {
 public:
  /// Knows nothing; for loading.
  explicit OutcomeField(DirectionBins directions) : directions_(directions) {}
  /// Takes the means of what `cells` have found. The mean of the same bin of the next larger cell
  /// is added to the steps of a bin, as if it came from `least_steps` further steps, and likewise
  /// with light samples. This larger cell is made of all cells below the plane that has made the
  /// cell, and so on up to the whole scene.
  OutcomeField(const OutcomeCells& cells, DirectionBins directions, double least_steps);

  /// Returns the expected values at a vertex. `towards_viewer` is a unit vector.
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

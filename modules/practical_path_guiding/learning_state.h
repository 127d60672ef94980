#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/random.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/toolkit/pixel_estimates.h>

#include "cells.h"
#include "larger_cells.h"
#include "learner.h"

namespace pharos::practical_path_guiding {

/// The state of learning during one render: a binary tree over a cube around the scene, with a
/// directional quadtree in each cell. Cells with many records are halved, across x, y and z in
/// turn.
class PracticalPathGuidingLearningState final : public LearningState {
 public:
  PracticalPathGuidingLearningState(const PracticalPathGuidingSettings& settings,
                                    const LearningContext& context);

  void absorb(const PathLog& log) override;
  Learned update(const TrainingStage& stage) override;
  void end_learning() override { records_ = {}; }
  void archive(Archive& archive) override;

 private:
  struct Cell {
    Bounds3 box;
    int level = 0;       ///< number of planes above the cell
    double records = 0;  ///< number of records in this iteration
    Sums sums;           ///< of this iteration, and what is kept of earlier ones
    /// Density of the last iteration that found light in the cell; empty: nothing known.
    std::vector<QuadNode> known;
    float known_light = 0;    ///< mean value of the steps behind `known`
    float known_records = 0;  ///< number of the records behind `known`

    /// Halves what the cell has accumulated, and counts a plane above it.
    void halve() {
      records /= 2;
      sums.scale(0.5);
      ++level;
    }
    void archive(Archive& archive) {
      archive(box, level, records, sums, known, known_light, known_records);
    }
  };

  LeafMass leaf_mass() const {
    return settings_.target == GuidingTarget::radiance ? LeafMass::sum : LeafMass::root;
  }
  QuadRefinement refinement() const {
    return {settings_.directional_threshold, settings_.directional_depth};
  }
  /// Adds the waiting records to their cells.
  void flush();
  /// Returns the cell that receives a record, by the spatial filter.
  std::uint32_t cell_for(const Record& record, RandomStream random) const;
  /// Replaces the cells' known densities by what they accumulated, and refines their trees for the
  /// next iteration.
  void conclude();
  /// Does so for one cell. `seen` are its sums, which may be mixed with the sums of larger cells.
  /// The known density stays if there is no light in them.
  void conclude(Cell& cell, const Sums& seen) const;
  /// Halves a cell of the tree over space, and then its halves, as long as a cell's share of the
  /// records is above `threshold`.
  void halve(std::uint32_t leaf, std::uint32_t cell, double threshold);
  /// Returns the cells that learn apart in a cell of the tree over space.
  std::span<Cell> cells_in(std::uint32_t cell) {
    return {cells_.data() + std::size_t{cell} * division_.in_each(), division_.in_each()};
  }
  std::shared_ptr<const GuidingModel> model() const;

  PracticalPathGuidingSettings settings_;
  std::uint64_t seed_;
  double film_pixels_;
  Bounds3 cube_;  ///< contains the scene
  Cells division_;
  std::vector<Cell> cells_;             ///< by the numbers of `division_`
  std::vector<std::uint32_t> origins_;  ///< cell of the last model that contained each cell
  PixelEstimates pixels_;
  std::uint64_t batches_ = 0;    ///< number of calls of flush()
  double paths_ = 0;             ///< number of paths in this iteration
  std::vector<Record> records_;  ///< records that wait for flush()
  std::vector<Rgb> incident_;    ///< scratch
};

}  // namespace pharos::practical_path_guiding

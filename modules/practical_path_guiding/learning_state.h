#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/random.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "learner.h"
#include "pixel_estimates.h"
#include "quad_tree.h"

namespace pharos::practical_path_guiding {

/// What is learned during one render: a binary tree over a cube around the scene whose cells are
/// halved where many records come, axis after axis, and a directional quadtree in each.
class PracticalPathGuidingLearningState final : public LearningState {
 public:
  PracticalPathGuidingLearningState(const PracticalPathGuidingSettings& settings,
                                    const LearningContext& context);

  void absorb(const PathLog& log) override;
  Learned update(std::uint32_t iteration, bool last) override;
  void archive(Archive& archive) override;

 private:
  struct Cell {
    Bounds3 box;
    int level = 0;                ///< planes above it
    double records = 0;           ///< of this iteration
    double light = 0;             ///< sum of their values
    QuadTree learning;            ///< of this iteration
    std::vector<QuadNode> known;  ///< as of the iteration before; none: nothing
    float known_light = 0;        ///< mean value of a record
    float known_records = 0;      ///< behind what is known

    void archive(Archive& archive) {
      archive(box, level, records, light, learning, known, known_light, known_records);
    }
  };

  LeafMass leaf_mass() const {
    return settings_.target == GuidingTarget::radiance ? LeafMass::sum : LeafMass::root;
  }
  QuadRefinement refinement() const {
    return {settings_.directional_threshold, settings_.directional_depth};
  }
  /// Adds the records that wait to their cells.
  void flush();
  /// The cell that learns from a record, by the spatial filter.
  std::uint32_t cell_for(const Record& record, RandomStream random) const;
  /// What a cell has learned becomes what it knows, and it begins anew.
  void conclude(Cell& cell) const;
  /// Halves a cell again and again, as long as its share of records is above `threshold`.
  void halve(std::uint32_t leaf, std::uint32_t cell, double threshold);
  std::shared_ptr<const GuidingModel> model() const;

  PracticalPathGuidingSettings settings_;
  std::uint64_t seed_;
  double film_pixels_;
  KdTree tree_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> origins_{0};  ///< of each cell, among those of the last model
  PixelEstimates pixels_;
  std::uint64_t batches_ = 0;    ///< calls of flush()
  double paths_ = 0;             ///< of this iteration
  std::vector<Record> records_;  ///< that wait
  std::vector<Rgb> incident_;    ///< scratch
};

}  // namespace pharos::practical_path_guiding

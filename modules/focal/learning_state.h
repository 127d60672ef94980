#pragma once

#include <cstdint>
#include <vector>

#include <pharos/guiding/contract/learner.h>

#include "learner.h"
#include "octree_refinement.h"
#include "splat.h"

namespace pharos::focal {

/// The state of learning during one render: two octrees that become finer where mass collects.
class FocalLearningState final : public LearningState {
 public:
  FocalLearningState(const FocalSettings& settings, const LearningContext& context);

  void absorb(const PathLog& log) override;
  Learned update(const TrainingStage& stage) override;
  void archive(Archive& archive) override;

 private:
  /// Returns whether the iteration after `stage` narrows the density.
  bool next_narrows(const TrainingStage& stage) const;
  /// Splats the waiting segments in concurrent groups. The groups do not depend on the number of
  /// threads, so the sums have the same bits.
  void splat_waiting();
  void splat(std::span<const Segment> segments, FocalSums& sums) const;
  void refine(double total_mass);
  void grow_region(double total_mass);
  /// Makes the refined octrees the current density and clears the sums.
  void use_octrees();
  std::shared_ptr<const GuidingModel> model(bool last) const;

  FocalSettings settings_;
  double diagonal_;  ///< diagonal of the initial region [scene units]
  int max_depth_;
  int growths_left_;  ///< how often the region may still double
  LearningOctree converging_, diverging_;
  FocalDensity density_;  ///< density of the current iteration
  double segments_ = 0;   ///< number of segments that the masses come from; `decay` lowers the
                          ///< numbers of earlier iterations
  bool knows_something_ = false;
  bool narrowing_ = false;

  // Data of the current iteration.
  FocalSums sums_;
  std::uint64_t paths_ = 0;
  std::uint64_t splatted_ = 0;     ///< number of segments in the sums
  std::vector<Segment> waiting_;   ///< segments that wait to be splatted
  std::vector<Rgb> incident_;      ///< scratch
  std::vector<FocalSums> groups_;  ///< scratch
};

}  // namespace pharos::focal

#pragma once

#include <cstdint>
#include <vector>

#include <pharos/guiding/contract/learner.h>

#include "learner.h"
#include "octree_refinement.h"
#include "splat.h"

namespace pharos::focal {

/// What is learned during one render: two octrees that become finer where mass collects.
class FocalLearningState final : public LearningState {
 public:
  FocalLearningState(const FocalSettings& settings, const LearningContext& context);

  void absorb(const PathLog& log) override;
  Learned update(std::uint32_t iteration, bool last) override;
  void archive(Archive& archive) override;

 private:
  bool narrows(std::uint32_t iteration) const;
  /// Splats the segments that wait, many at a time and always in the same groups.
  void splat_waiting();
  void splat(std::span<const Segment> segments, FocalSums& sums) const;
  void refine(double total_mass);
  void grow_region(double total_mass);
  /// Puts the refined octrees in force.
  void use_octrees();
  std::shared_ptr<const GuidingModel> model(bool last) const;

  FocalSettings settings_;
  std::uint32_t first_narrowing_;  ///< iteration
  double diagonal_;                ///< of the region at first [scene units]
  int max_depth_;
  int growths_left_;  ///< how often the region may still double
  LearningOctree converging_, diverging_;
  FocalDensity density_;  ///< in force in this iteration
  bool knows_something_ = false;
  bool narrowing_ = false;

  // Of this iteration.
  FocalSums sums_;
  std::uint64_t paths_ = 0;
  std::vector<Segment> waiting_;
  std::vector<Rgb> incident_;      ///< scratch
  std::vector<FocalSums> groups_;  ///< scratch
};

}  // namespace pharos::focal

#pragma once

#include <cstdint>
#include <vector>

#include <pharos/guiding/contract/learner.h>
#include <pharos/statistics/varopt.h>

#include "learner.h"
#include "local_density.h"
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
  using Splat = void (FocalLearningState::*)(std::span<const Segment>, FocalSums&) const;
  /// Splats segments in concurrent groups, a limited number at a time. The groups do not depend on
  /// the number of threads, so the sums have the same bits.
  void splat_in_groups(std::span<const Segment> segments, Splat splat);
  void splat_waiting();
  void splat_new(std::span<const Segment> segments, FocalSums& sums) const;
  void splat_kept(std::span<const Segment> segments, FocalSums& sums) const;
  /// Narrows the density by segments of each cell of space, with the density of this cell.
  void splat_by_cell(std::span<const Segment> segments);
  /// Sets the masses to `decay` times themselves plus the sums, and refines the octrees.
  void learn_sums(double decay);
  bool has_enough_light() const;
  /// If this iteration has enough light, narrows the density once for each missed one, with the
  /// segments that were kept. Otherwise this one is missed, too.
  void catch_up();
  void refine();
  void grow_region();
  /// Makes the refined octrees the current density and clears the sums.
  void use_octrees();
  /// Ends an iteration in the cells of space.
  void learn_uses();
  /// Computes the densities of the cells of space.
  void use_local_densities();
  const FocalDensity& density_in(std::size_t cell) const {
    return local_.empty() ? density_ : local_[cell];
  }
  std::shared_ptr<const GuidingModel> model(bool last) const;

  FocalSettings settings_;
  double diagonal_;  ///< diagonal of the initial region [scene units]
  int max_depth_;
  int growths_left_;  ///< how often the region may still double
  LearningOctree converging_, diverging_;
  FocalDensity density_;             ///< density of the current iteration
  CellGrid grid_;                    ///< cells of space
  std::vector<LocalUse> uses_;       ///< by cell of space, of all iterations that have narrowed
  std::vector<FocalDensity> local_;  ///< densities in the cells; empty: `density_` in all of them
  double segments_ = 0;  ///< number of segments that the masses come from; `decay` lowers the
                         ///< numbers of earlier iterations
  bool knows_something_ = false;
  bool narrowing_ = false;
  std::uint64_t seed_;
  int missed_ = 0;             ///< iterations with too little light to narrow the density
  std::uint64_t batches_ = 0;  ///< of which segments were kept; a key of random numbers

  // Data of the current iteration.
  FocalSums sums_;
  std::uint64_t paths_ = 0;
  std::uint64_t splatted_ = 0;                 ///< number of segments in the sums
  std::vector<LocalUse> new_uses_;             ///< by cell of space
  std::vector<Segment> waiting_;               ///< segments that wait to be splatted
  statistics::VarOptReservoir<Segment> kept_;  ///< to catch up
  double squares_ = 0;  ///< sum of squared contributions of all segments that `kept_` was given
  std::vector<Rgb> incident_;      ///< scratch
  std::vector<FocalSums> groups_;  ///< scratch
};

}  // namespace pharos::focal

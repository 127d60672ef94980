#pragma once

#include <cstdint>
#include <vector>

#include <pharos/guiding/learner.h>
#include <pharos/guiding/learning_cells.h>

#include "cell_mixture.h"

namespace pharos::vmf {

/// What is learned during one render: a tree whose cells are divided where many samples come, and a
/// mixture in each.
class VmfState final : public LearningState {
 public:
  VmfState(const VmfSettings& settings, const LearningContext& context);

  void absorb(const PathLog& log) override;
  std::shared_ptr<const GuidingModel> update(std::uint32_t iteration, bool last) override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  void merge(const LearningState& other) override;

 private:
  /// Learns from the samples that wait: at the end of an iteration, or when they are many.
  void learn();
  std::shared_ptr<const GuidingModel> model() const;

  VmfSettings settings_;
  LearningCells<Sample, CellMixture> cells_;
  std::uint64_t lessons_ = 0;    ///< calls of learn()
  bool learned_early_ = false;   ///< from samples of this iteration, before its end
  std::vector<Sample> samples_;  ///< that wait
  PathScratch scratch_;
};

}  // namespace pharos::vmf

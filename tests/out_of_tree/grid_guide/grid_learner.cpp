#include "grid_learner.h"

#include <pharos/guiding/toolkit/guidable_steps.h>

#include "grid_model.h"

namespace grid_guide {

using namespace pharos;

namespace {

/// The sums of one iteration. Logs come in a fixed order, so the sums do not depend on the number
/// of threads.
class GridState final : public LearningState {
 public:
  explicit GridState(Grid grid) : grid_(grid), sums_(grid.cell_count()) {}

  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) {
      for_each_guidable_step(log[i], incident_, [this](const GuidableStep& step) {
        CellSums& cell = sums_[grid_.cell_of(step.from.position)];
        // Radiance over density is an estimate of the radiance in the bin, times its solid angle.
        cell.radiance[bin_of(step.from.direction)] += mean(step.radiance) / step.pdf;
        cell.steps += step.from.continuation;
      });
    }
  }

  Learned update(const TrainingStage&) override {
    auto model = std::make_shared<GridModel>(grid_, sums_);
    sums_.assign(grid_.cell_count(), {});
    return {std::move(model)};
  }

  void archive(Archive& archive) override {
    archive.heading("grid state", 1);
    for (CellSums& cell : sums_) {
      archive(cell.radiance, cell.steps);
      archive.expect(cell.radiance.size() == kBins, "a histogram");
    }
  }

 private:
  Grid grid_;
  std::vector<CellSums> sums_;  ///< by cell
  std::vector<Rgb> incident_;   ///< of one path; a member, so that it keeps its memory
};

}  // namespace

LearnerTraits GridLearner::traits() const {
  return {.records = {.light_samples = true}};  // they are part of the radiance along a step
}

std::unique_ptr<LearningState> GridLearner::begin(const LearningContext& context) const {
  return std::make_unique<GridState>(Grid{context.region, settings_.cells});
}

std::shared_ptr<GuidingModel> GridLearner::empty_model() const {
  return std::make_shared<GridModel>();
}

}  // namespace grid_guide

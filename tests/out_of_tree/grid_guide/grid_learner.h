#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/learner.h>

namespace grid_guide {

/// Learns the directions of light in the cells of a grid, in each iteration anew.
class GridLearner final : public pharos::Learner {
 public:
  struct Settings {
    std::uint32_t cells = 8;
    static void describe(pharos::Schema<Settings>& s) {
      s.field("cells", &Settings::cells, "Number of cells along each axis of the scene's bounds")
          .at_least(1)
          .at_most(64);
    }
  };
  explicit GridLearner(const Settings& settings) : settings_(settings) {}

  pharos::LearnerTraits traits() const override;
  std::unique_ptr<pharos::LearningState> begin(
      const pharos::LearningContext& context) const override;
  std::shared_ptr<pharos::GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace grid_guide

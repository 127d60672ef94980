// uniform (learner): learns the mean radiance that arrived along the steps of the last iteration's
// paths. The guider ignores this number, but pictures of the model show it. The pair `uniform`
// serves as a reference for comparisons and as a template for new plugins.
//
//     guiding: { learner: uniform, guider: uniform }
#include "uniform_learner.h"

#include <utility>

#include "uniform_model.h"

namespace pharos {
namespace {

/// Sums over the steps that were recorded since the last update. The calls come in a fixed order,
/// so the sums are the same for any number of threads.
class UniformState final : public LearningState {
 public:
  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) {
      const PathView path = log[i];
      if (path.transport != Transport::radiance) continue;
      estimate_incident_radiance(path, incident_);
      for (std::size_t k = 0; k < path.vertices.size(); ++k) {
        // Vertices at which no guide will ever be asked teach nothing. Steps that found no light
        // count, because they show that it is dark there.
        if (!path.vertices[k].guidable) continue;
        // The branches of a vertex count for one step together. A step that has survived roulette
        // also counts for those that have not.
        radiance_ += path.vertices[k].continuation * mean(incident_[k]);
        steps_ += path.vertices[k].continuation;
      }
    }
  }

  Learned update(const TrainingStage&) override {
    const double radiance = std::exchange(radiance_, 0);
    const double steps = std::exchange(steps_, 0);
    return {std::make_shared<UniformModel>(steps > 0 ? radiance / steps : 0.0)};
  }

  /// Saves or loads the state. The heading names what follows; its version must be raised with
  /// every change.
  void archive(Archive& archive) override {
    archive.heading("uniform state", 3);
    archive(radiance_, steps_);
  }

 private:
  double radiance_ = 0;
  double steps_ = 0;
  std::vector<Rgb> incident_;  ///< of one path; a member, so that it keeps its memory
};

}  // namespace

LearnerTraits UniformLearner::traits() const {
  // Light samples at the end of a step are part of the radiance that arrives along the step.
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> UniformLearner::begin(const LearningContext&) const {
  return std::make_unique<UniformState>();
}

std::shared_ptr<GuidingModel> UniformLearner::empty_model() const {
  return std::make_shared<UniformModel>();
}

}  // namespace pharos

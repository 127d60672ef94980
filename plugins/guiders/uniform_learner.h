#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/learner.h>

namespace pharos {

/// See uniform_learner.cpp.
class UniformLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit UniformLearner(const Settings& = {}) {}

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;
};

}  // namespace pharos

#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/learner.h>

namespace pharos::testing {

enum class LearnerFault {
  none,
  branches_counted,  ///< each branch of a vertex counts as a whole step
};

struct RetellingSettings {
  LearnerFault fault = LearnerFault::none;
  Ref<Learner> learner;
  static void describe(Schema<RetellingSettings>& s);
};

/// A decorator of another learner. See faulty_learner.cpp.
class RetellingLearner final : public Learner {
 public:
  using Settings = RetellingSettings;
  explicit RetellingLearner(Settings settings) : settings_(std::move(settings)) {}

  LearnerTraits traits() const override { return settings_.learner->traits(); }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override {
    return settings_.learner->empty_model();
  }

 private:
  Settings settings_;
};

}  // namespace pharos::testing

namespace pharos {
template <>
struct EnumNames<testing::LearnerFault> {
  static constexpr auto names = std::to_array<EnumName<testing::LearnerFault>>(
      {{"none", testing::LearnerFault::none},
       {"branches_counted", testing::LearnerFault::branches_counted}});
};
}  // namespace pharos

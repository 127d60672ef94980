// A learner that passes on to another learner what it is told of paths, correctly or with a planted
// fault:
//
//     learner: { type: retelling, fault: branches_counted, learner: uniform }

#include "faulty_learner.h"

namespace pharos::testing {
namespace {

class RetellingState final : public LearningState {
 public:
  RetellingState(std::unique_ptr<LearningState> inner, LearnerFault fault)
      : inner_(std::move(inner)), fault_(fault) {}

  void absorb(const PathLog& log) override {
    PathLog told;
    for (std::size_t i = 0; i < log.size(); ++i) tell(log[i], told);
    inner_->absorb(told);
  }
  Learned update(const TrainingStage& stage) override { return inner_->update(stage); }
  void end_learning() override { inner_->end_learning(); }
  void archive(Archive& archive) override { inner_->archive(archive); }

 private:
  void tell(const PathView& path, PathLog& told) const {
    told.begin_path(path.film, path.transport);
    told.set_features(path.albedo, path.normal);
    for (const RecordedVertex& vertex : path.vertices) {
      RecordedVertex copy = vertex;
      copy.next = copy.twin = kNoVertex;  // the log sets them again
      // Steps that roulette has ended stay ended.
      const bool is_whole = fault_ == LearnerFault::branches_counted && copy.continuation > 0;
      if (is_whole) copy.continuation = 1;
      told.set_techniques(told.add(copy), path.techniques(vertex));
    }
    for (const RecordedLightSample& sample : path.light_samples) told.add(sample);
  }

  std::unique_ptr<LearningState> inner_;
  LearnerFault fault_;
};

}  // namespace

void RetellingSettings::describe(Schema<RetellingSettings>& s) {
  s.field("fault", &RetellingSettings::fault, "The planted fault");
  s.field("learner", &RetellingSettings::learner, "Learner to which paths are passed on")
      .otherwise("uniform");
}

std::unique_ptr<LearningState> RetellingLearner::begin(const LearningContext& context) const {
  return std::make_unique<RetellingState>(settings_.learner->begin(context), settings_.fault);
}

}  // namespace pharos::testing

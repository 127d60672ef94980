#include <pharos/core/random.h>
#include <pharos/rendering/render_learning.h>

namespace pharos {

RenderLearning::RenderLearning(const Integrator& integrator, const LearningContext& context) {
  if (const GuidingSettings* settings = integrator.guiding()) {
    guiding_ = std::make_unique<GuidingState>(*settings, context);
  }
  if (const Termination* termination = integrator.learned_termination()) {
    // Guides take the seeds of small numbers.
    LearningContext own = context;
    own.seed = hash_combine(context.seed, ~std::uint64_t{0});
    termination_ = termination->begin(own);
  }
  apply();
}

void RenderLearning::apply() {
  if (guiding_ != nullptr) frame_ = guiding_->frame();
  if (termination_ != nullptr) rule_ = termination_->rule();
}

void RenderLearning::absorb(const PathLog& log) {
  if (guiding_ != nullptr) guiding_->absorb(log);
  if (termination_ != nullptr) termination_->absorb(log);
}

bool RenderLearning::may_end_training(IterationCost cost) {
  // Without a learned rule, guides alone make paths longer. They pay for it.
  if (termination_ == nullptr) cost.steps = 1;
  return guiding_ != nullptr && guiding_->may_end_training(cost);
}

double RenderLearning::worthwhile_share() const {
  return guiding_ == nullptr ? 1 : guiding_->worthwhile_share();
}

void RenderLearning::update(const TrainingStage& stage) {
  if (guiding_ != nullptr) guiding_->update(stage);
  if (termination_ != nullptr) termination_->update(stage);
  apply();
}

double RenderLearning::samples_per_region() const {
  return guiding_ == nullptr ? 0 : guiding_->samples_per_region();
}

void RenderLearning::archive(Archive& archive) {
  if (guiding_ != nullptr) guiding_->archive(archive);
  if (termination_ != nullptr) termination_->archive(archive);
  if (archive.loads()) apply();
}

void RenderLearning::archive_frozen(Archive& archive) {
  bool has_guides = frame_ != nullptr;
  archive(has_guides);
  if (has_guides) guiding_->archive_guides(archive);
  if (termination_ != nullptr) termination_->archive_rule(archive);
  if (!archive.loads()) return;
  apply();
  if (!has_guides) frame_ = nullptr;
}

}  // namespace pharos

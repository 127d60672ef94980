#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <pharos/core/bounds.h>

#include "learner.h"
#include "pgl_field.h"
#include "sample.h"

namespace pharos::open_pgl {

/// The state of learning during one render: a field of the library. A field changes in place, so
/// models are copies of it, made through the library's files.
class OpenPglLearningState final : public LearningState {
 public:
  OpenPglLearningState(const OpenPglSettings& settings, const Bounds3& region);

  void absorb(const PathLog& log) override;
  Learned update(const TrainingStage& stage) override;
  void archive(Archive& archive) override;

 private:
  /// Lets the field learn from the waiting samples. Called at the end of an iteration, or earlier
  /// if there are `batch_samples`.
  void learn();

  OpenPglSettings settings_;
  Bounds3 region_;
  SampleRule rule_;
  std::unique_ptr<openpgl::cpp::Field> field_;
  std::uint64_t lessons_ = 0;    ///< number of calls of learn() with samples
  std::vector<Sample> samples_;  ///< samples that wait for learn()
  PathScratch scratch_;
};

}  // namespace pharos::open_pgl

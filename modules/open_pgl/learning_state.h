#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <pharos/core/bounds.h>

#include "learner.h"
#include "pgl_field.h"
#include "sample.h"

namespace pharos::open_pgl {

/// A field that learns during one render. The models it gives away are copies, made by way of the
/// library's files, as fields change in place.
class OpenPglLearningState final : public LearningState {
 public:
  OpenPglLearningState(const OpenPglSettings& settings, const Bounds3& region);

  void absorb(const PathLog& log) override;
  Learned update(std::uint32_t iteration, bool last) override;
  void archive(Archive& archive) override;

 private:
  /// Lets the field learn from the samples that wait: at the end of an iteration, or when they are
  /// many.
  void learn();

  OpenPglSettings settings_;
  Bounds3 region_;
  SampleRule rule_;
  std::unique_ptr<openpgl::cpp::Field> field_;
  std::uint64_t lessons_ = 0;    ///< calls of learn() with samples
  std::vector<Sample> samples_;  ///< that wait
  PathScratch scratch_;
};

}  // namespace pharos::open_pgl

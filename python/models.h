#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <pharos/guiding/pipeline/model_file.h>

#include "values.h"

namespace pharos::python {

/// A learned model: `pharos.GuidingModel`.
class GuidingModel {
 public:
  explicit GuidingModel(LearnedModel learned) : learned_(std::move(learned)) {}
  /// Reads model number `index` of a file. Throws InputError.
  GuidingModel(const std::filesystem::path& file, std::size_t index);

  const std::string& learner() const { return learned_.learner; }
  ModelInfo info() const { return learned_.model->info(); }
  /// Returns the densities at points, an array of shape (n, 3), or for a direction at each point.
  /// One point or one direction goes with all of the others. Throws InputError for other shapes,
  /// for numbers that are not finite, and for directions of length zero.
  Doubles density(const Floats& points, const std::optional<Floats>& directions) const;

 private:
  LearnedModel learned_;
};

}  // namespace pharos::python

#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/experiments/pictures/share_slices.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {

/// The content of a model file: everything that a render has learned.
struct LearnedFile {
  ModelFileHead head;
  std::vector<std::shared_ptr<const GuidingModel>> models;  ///< in the order of `head.models`
  LearnedMixing mixing;
};

/// Reads everything in a model file. Throws InputError without location if the file is damaged or
/// names plugins that no module has.
LearnedFile read_learned_file(const std::filesystem::path& path, const Registry& registry);

}  // namespace pharos

#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/experiments/pictures/share_slices.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {

/// The roughness values for which `pharos inspect` shows shares: one of each class of surfaces that
/// the policy `simplex` tells apart.
inline constexpr std::array kShownRoughness{0.05f, 0.25f, 1.0f};

/// What a render has learned, read from a model file.
struct InspectedFile {
  ModelFileHead head;
  std::vector<std::shared_ptr<const GuidingModel>> models;
  LearnedMixing mixing;
};

/// Reads everything in a model file. Throws InputError if the file is damaged or names plugins that
/// no module has.
InspectedFile read_inspected(const std::filesystem::path& path, const Registry& registry);

/// Returns the coordinates with six digits, in brackets.
std::string point_text(Point3 p);

/// Prints the facts about all models, and the mean shares of their methods in `bounds`, if the
/// bounds are not empty.
void print_facts(const InspectedFile& file, Bounds3 bounds);

}  // namespace pharos

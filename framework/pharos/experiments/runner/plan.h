#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/experiments/runner/experiment_config.h>

namespace pharos {

/// One method on one scene, without its seed.
struct PlannedCell {
  std::size_t scene = 0, method = 0;  ///< indices into the experiment's lists
  ConfigNode config;                  ///< of the render, budget included
  std::string text;                   ///< the same with every value in force, but for the seed
  std::string key;                    ///< of its content and of the code that renders it
};

/// The reference of a scene: a file, or a render.
struct PlannedReference {
  std::filesystem::path file;  ///< empty when it is to be rendered
  ConfigNode config;           ///< of one part of a render
  std::uint32_t parts = 0;     ///< of a render; 0: it is a file
  int width = 0, height = 0;   ///< of the scene's images
};

/// All that an experiment renders.
struct ExperimentPlan {
  std::vector<PlannedReference> references;  ///< one a scene
  std::vector<PlannedCell> cells;            ///< scene by scene, in each method by method
};

/// Lays methods over scenes and builds every combination once, so that whatever is wrong comes out
/// before anything is rendered: throws InputError.
ExperimentPlan plan_experiment(const ExperimentConfig& config, const Registry& registry);

/// Channels R, G and B of an image file that is to be of this size. Throws InputError for a file
/// that cannot be read, is of another size, has other channels or values that are not finite.
Image read_reference(const std::filesystem::path& file, int width, int height);

/// A config with a seed, to be rendered.
LoadedConfig build_run(const ConfigNode& config, std::uint64_t seed, const Registry& registry);

}  // namespace pharos

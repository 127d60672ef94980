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
  ConfigNode config;                  ///< config of the render, budget included
  std::string text;                   ///< YAML with every value in force, without seed and output
  float exposure = 0;                 ///< OutputSettings::exposure [stops]
  std::string build;                  ///< build_key() of the code that renders it
  std::string key;                    ///< key of the config's content and of `build`
  std::vector<std::string> papers;    ///< to be cited for the plugins in use
};

/// The first seed of references, far from the seeds of runs.
inline constexpr std::uint64_t kReferenceSeed = std::uint64_t{1} << 40;

/// The reference of a scene: a file or a render.
struct PlannedReference {
  std::filesystem::path file;  ///< empty if the reference is to be rendered
  ConfigNode config;           ///< config of one part of a render
  std::string build;           ///< build_key() of the code that renders it
  std::uint32_t parts = 0;     ///< number of parts of a render; 0: the reference is a file
  int width = 0, height = 0;   ///< size of the scene's images [pixels]
  std::string key;             ///< key of the image, or of everything that determines its render
};

/// Everything that an experiment renders.
struct ExperimentPlan {
  std::vector<PlannedReference> references;  ///< one per scene
  std::vector<PlannedCell> cells;            ///< ordered by scene, then by method
};

/// Combines methods with scenes and builds every combination once, so that all errors are found
/// before anything is rendered. Throws InputError.
ExperimentPlan plan_experiment(const ExperimentConfig& config, const Registry& registry);

/// Reads channels R, G and B of an image file that must have this size. Throws InputError if the
/// file cannot be read, has another size, lacks channels, or has values that are not finite.
Image read_reference(const std::filesystem::path& file, int width, int height);

/// Builds a config with a seed, ready to be rendered.
LoadedConfig build_run(const ConfigNode& config, std::uint64_t seed, const Registry& registry);

}  // namespace pharos

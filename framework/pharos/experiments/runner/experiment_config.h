#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/experiments/runner/child.h>
#include <pharos/rendering/budget.h>
#include <pharos/rendering/render_config.h>

/// The config of an experiment: scenes x methods x seeds. Scenes and methods may have budgets of
/// their own.
namespace pharos {

/// The source of the reference image: an image file, or a render of `spp` samples per pixel with
/// the scene's own config and `settings` applied to it.
struct ReferenceSettings {
  std::filesystem::path image;
  std::uint32_t spp = 0;
  std::uint32_t parts = 8;  ///< number of independent renders that share `spp`; even
  ConfigNode settings = ConfigNode::mapping();

  bool given() const { return !image.empty() || spp > 0; }
  static void describe(Schema<ReferenceSettings>& schema);
};

/// A render config and settings that override its values.
struct ExperimentScene {
  std::string name;
  std::filesystem::path config;
  ConfigNode settings = ConfigNode::mapping();
  ReferenceSettings reference;   ///< replaces the experiment's reference
  std::optional<Budget> budget;  ///< replaces the experiment's budget
  bool optional = false;         ///< left out if its config does not exist

  static void describe(Schema<ExperimentScene>& schema);
};

/// A method: settings that override values of every scene's config.
struct ExperimentMethod {
  std::string name;
  std::filesystem::path config;  ///< such as a preset; `settings` override it; empty: none
  ConfigNode settings = ConfigNode::mapping();
  std::optional<std::uint32_t> seeds;  ///< runs on each scene, if fewer than of other methods
  std::optional<Budget> budget;        ///< replaces the budgets of the experiment and its scenes

  static void describe(Schema<ExperimentMethod>& schema);
};

/// The runs whose images are kept as files. The report shows the first seed's images.
enum class KeptImages { first, all };

template <>
struct EnumNames<KeptImages> {
  static constexpr auto names =
      std::to_array<EnumName<KeptImages>>({{"first", KeptImages::first}, {"all", KeptImages::all}});
};

struct ExperimentConfig {
  std::string title, description;
  std::vector<ExperimentScene> scenes;
  std::vector<ExperimentMethod> methods;
  ConfigNode settings = ConfigNode::mapping();  ///< applied to the configs of all scenes
  Budget budget;                                ///< budget of every run, training included
  std::uint32_t seeds = 8;                      ///< number of runs of each method on each scene
  std::uint64_t first_seed = 1;
  std::string baseline;  ///< denominator of ratios; empty: the first method
  ReferenceSettings reference;
  KeptImages images = KeptImages::first;
  std::optional<double> time_limit;    ///< of a run [s]; none: unlimited
  std::optional<double> memory_limit;  ///< address space of a run [GiB]; none: unlimited
  std::string output;                  ///< folder, relative to the current one
  std::filesystem::path cache;         ///< folder of references; empty: the user's cache folder

  std::filesystem::path source;           ///< absolute path of the file it was read from
  std::vector<ExperimentScene> left_out;  ///< optional scenes whose config does not exist

  /// Returns the limits of the process that makes a run.
  ChildLimits limits() const;
  /// Returns the folder of references.
  std::filesystem::path reference_cache() const;
  /// Returns the budget of every run of a method on a scene.
  const Budget& budget_of(const ExperimentScene& scene, const ExperimentMethod& method) const {
    return method.budget ? *method.budget : scene.budget ? *scene.budget : budget;
  }

  /// Returns the number of runs of a method on each scene.
  std::uint32_t seeds_of(const ExperimentMethod& method) const {
    return std::min(method.seeds.value_or(seeds), seeds);
  }

  static void describe(Schema<ExperimentConfig>& schema);
};

/// Reads an experiment file, follows `extends`, applies `overrides` and makes the checks that
/// concern several values: names exist and are unique, the baseline is a method. Moves optional
/// scenes without a config file to `left_out`. Throws InputError.
ExperimentConfig load_experiment(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides,
                                 const Registry& registry);

}  // namespace pharos

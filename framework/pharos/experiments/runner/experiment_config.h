#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/rendering/budget.h>
#include <pharos/rendering/render_config.h>

/// What an experiment file says: scenes x methods x seeds at one budget a scene.
namespace pharos {

/// Where the images come from that errors are measured against: an image file, or a render of
/// `spp` samples a pixel by the scene's own config with `settings` laid over it.
struct ReferenceSettings {
  std::filesystem::path image;
  std::uint32_t spp = 0;
  std::uint32_t parts = 8;  ///< independent renders that `spp` is divided into, even
  ConfigNode settings = ConfigNode::mapping();

  bool given() const { return !image.empty() || spp > 0; }
  static void describe(Schema<ReferenceSettings>& schema);
};

/// A render config, with settings that are laid over it.
struct ExperimentScene {
  std::string name;
  std::filesystem::path config;
  ConfigNode settings = ConfigNode::mapping();
  ReferenceSettings reference;   ///< instead of the experiment's
  std::optional<Budget> budget;  ///< instead of the experiment's

  static void describe(Schema<ExperimentScene>& schema);
};

/// Settings that are laid over every scene's config: what is compared.
struct ExperimentMethod {
  std::string name;
  std::filesystem::path config;  ///< such as a preset, below `settings`; empty: none
  ConfigNode settings = ConfigNode::mapping();

  static void describe(Schema<ExperimentMethod>& schema);
};

/// Whose images are kept as files; the first seed's stand in the report.
enum class KeptImages { first, all };

template <>
struct EnumNames<KeptImages> {
  static constexpr std::array<std::pair<std::string_view, KeptImages>, 2> names{
      {{"first", KeptImages::first}, {"all", KeptImages::all}}};
};

struct ExperimentConfig {
  std::string title, description;
  std::vector<ExperimentScene> scenes;
  std::vector<ExperimentMethod> methods;
  ConfigNode settings = ConfigNode::mapping();  ///< laid over all scenes' configs
  Budget budget;                                ///< of every run, training included
  std::uint32_t seeds = 8;                      ///< runs of each method on each scene
  std::uint64_t first_seed = 1;
  std::string baseline;  ///< the method that ratios are to; empty: the first
  ReferenceSettings reference;
  KeptImages images = KeptImages::first;
  std::string output;           ///< folder, relative to the current one
  std::filesystem::path cache;  ///< of references; empty: the user's cache folder

  std::filesystem::path source;  ///< the file it was read from, absolute

  /// What every run of a scene may cost.
  const Budget& budget_of(const ExperimentScene& scene) const {
    return scene.budget ? *scene.budget : budget;
  }

  static void describe(Schema<ExperimentConfig>& schema);
};

/// Reads an experiment file, follows `extends`, applies `overrides` and checks what no single value
/// shows: names are there and different, the baseline is a method. Throws InputError.
ExperimentConfig load_experiment(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides,
                                 const Registry& registry);

}  // namespace pharos

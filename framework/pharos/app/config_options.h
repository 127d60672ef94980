#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <pharos/config/registry.h>
#include <pharos/core/confinement.h>
#include <pharos/core/user_cache.h>

namespace pharos {

/// The options that name a config, shared by all subcommands that read one.
struct ConfigOptions {
  std::string path;
  std::vector<std::string> overrides;
  bool strict = false;

  void add_to(CLI::App& command,
              const char* description = "Render config (YAML), or a scene that can be imported") {
    command.add_option("config", path, description)->required();
    command.add_option("--set", overrides, "Override one value, such as --set film.width=256")
        ->take_all()
        ->expected(1)
        ->type_name("KEY=VALUE");
    command.add_flag("--strict", strict, "Take what an imported scene approximates for an error");
  }
};

/// The option that restricts what configs and scenes of others may read.
struct ConfineOption {
  std::optional<std::string> folder;  ///< below which all input must lie; none: anywhere

  void add_to(CLI::App& command) {
    command.add_option("--confine", folder, "Read input only from files below this folder");
  }
  /// Restricts reading to the folder, the presets and the user's cache.
  void apply(const Registry& registry) const {
    if (!folder) return;
    confine_reading(*folder);
    for (const std::string& each : registry.searched_folders()) allow_reading(each);
    allow_reading(user_cache_folder());
  }
};

}  // namespace pharos

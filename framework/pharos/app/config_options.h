#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

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

}  // namespace pharos

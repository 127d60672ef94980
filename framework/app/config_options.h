#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace pharos {

/// The options that name a config: shared by all subcommands that read one.
struct ConfigOptions {
  std::string path;
  std::vector<std::string> overrides;

  void add_to(CLI::App& command) {
    command.add_option("config", path, "Render config (YAML)")->required();
    command.add_option("--set", overrides, "Override one value, such as --set film.width=256")
        ->take_all()
        ->expected(1)
        ->type_name("KEY=VALUE");
  }
};

}  // namespace pharos

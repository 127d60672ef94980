#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/rendering/render_config.h>

#include "commands.h"
#include "config_options.h"
#include "import_notes.h"

namespace pharos {

void add_validate_command(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("validate", "Check a config and print it with every value in force");
  const auto options = std::make_shared<ConfigOptions>();
  const auto confine = std::make_shared<ConfineOption>();
  options->add_to(*command);
  confine->add_to(*command);
  command->callback([options, confine] {
    const Registry registry = load_default_modules();
    confine->apply(registry);
    const LoadedConfig loaded = load_render_config(options->path, options->overrides, registry);
    tell_notes(loaded.notes, options->strict);
    fmt::print("{}", to_yaml(loaded.resolved));
  });
}

}  // namespace pharos

#pragma once

#include <string>

#include <pharos/config/registry.h>

namespace CLI {
class App;
}

namespace pharos {

/// Whether the program has a subcommand of this name.
bool has_command(const CLI::App& app, const std::string& name);

/// Adds every registered Command as a subcommand, whose callback stores the exit code in
/// `exit_code`. The registry must outlive the parsing. Throws InputError if `app` already has a
/// command of the same name.
void add_module_commands(CLI::App& app, const Registry& registry, int& exit_code);

}  // namespace pharos

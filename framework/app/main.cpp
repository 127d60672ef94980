#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/version.h>

#include "commands.h"

namespace {

/// Runs the program and turns every error into one message and an exit code.
int run(int argc, char** argv) {
  using namespace pharos;
  CLI::App app("Pharos: path guiding and Monte Carlo sampling in rendering");
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  int exit_code = kDone;
  add_render_command(app, exit_code);
  add_validate_command(app, exit_code);
  add_plugins_command(app, exit_code);
  add_conformance_command(app, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "pharos: error: {}\nRun 'pharos --help' for usage.\n", error.what());
    return kBadInput;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pharos: error: {}\n", error.what());
    return kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv);
}

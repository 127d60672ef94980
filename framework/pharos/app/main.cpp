#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/version.h>

#include "commands.h"
#include "module_commands.h"

namespace {

/// Whether the modules are needed to parse the command line. They are, unless the first argument is
/// --version or a subcommand of the program itself.
bool needs_modules(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  return first != "--version" && !pharos::has_command(app, first);
}

/// Checks that the first argument is a subcommand or an option, because the message of CLI11 would
/// not name the mistake.
void check_command(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  const std::string first = argc > 1 ? argv[1] : "";
  const bool is_option = first.size() > 1 && first[0] == '-';
  if (is_option || std::find(known.begin(), known.end(), first) != known.end()) return;
  throw pharos::InputError(fmt::format("pharos: error: expected a command, one of {}, found '{}'{}",
                                       pharos::quoted_list(known), first,
                                       pharos::suggestion(first, known)));
}

/// Makes the C library keep freed memory instead of returning it to the system. Every work unit
/// needs megabytes for path records or splats, and the system would clear all of their pages again.
void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kLargestFromHeap = 32 << 20;  // [bytes] the largest value that glibc accepts
  constexpr int kMostKept = 1 << 30;          // [bytes]
  mallopt(M_MMAP_THRESHOLD, kLargestFromHeap);
  mallopt(M_TRIM_THRESHOLD, kMostKept);
#endif
}

/// Prints the flaws of an input, one a line.
void print_flaws(const std::vector<pharos::InputError>& flaws) {
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < std::min(flaws.size(), kMost); ++i) {
    fmt::print(stderr, "{}\n", flaws[i].what());
  }
  if (flaws.size() > kMost) {
    fmt::print(stderr, "at least {} more errors\n", flaws.size() - kMost);
  }
}

/// Runs the program and turns every error into one message and an exit code.
int run(int argc, char** argv) {
  using namespace pharos;
  CLI::App app("Pharos: path guiding and Monte Carlo sampling in rendering");
  app.set_version_flag("--version", version());
  int exit_code = kDone;
  add_render_command(app, exit_code);
  add_validate_command(app, exit_code);
  add_plugins_command(app, exit_code);
  add_conformance_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_experiment_command(app, exit_code);
  add_experiment_run_command(app, exit_code);
  add_convergence_command(app, exit_code);
  add_inspect_command(app, exit_code);
  add_points_command(app, exit_code);
  add_import_command(app, exit_code);
  Registry modules;
  try {
    if (needs_modules(app, argc, argv)) {
      modules = load_default_modules();
      add_module_commands(app, modules, exit_code);
    }
    check_command(app, argc, argv);
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw InputError("pharos: error: expected a command");
    return exit_code;
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "pharos: error: {} (pharos --help shows what there is)\n",
               one_line(error.what()));
    return kBadInput;
  } catch (const InputErrors& errors) {
    print_flaws(errors.all());
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
  keep_freed_memory();
  const int exit_code = run(argc, argv);
  if (std::fflush(stdout) == 0) return exit_code;
  fmt::print(stderr, "pharos: error: cannot write the output: {}\n", std::strerror(errno));
  return pharos::kFailed;
}

#pragma once

namespace CLI {
class App;
}

namespace pharos {

/// The exit codes of the program. kTooDifferent means that an image is further from the reference
/// than allowed.
enum ExitCode { kDone = 0, kTooDifferent = 1, kBadInput = 2, kFailed = 3, kInterrupted = 130 };

/// Each function adds one subcommand to the program. Its callback stores the exit code in
/// `exit_code`.
void add_render_command(CLI::App& app, int& exit_code);
void add_plugins_command(CLI::App& app, int& exit_code);
void add_validate_command(CLI::App& app, int& exit_code);
void add_conformance_command(CLI::App& app, int& exit_code);
void add_convergence_command(CLI::App& app, int& exit_code);
void add_experiment_command(CLI::App& app, int& exit_code);
void add_experiment_run_command(CLI::App& app, int& exit_code);
void add_import_command(CLI::App& app, int& exit_code);
void add_inspect_command(CLI::App& app, int& exit_code);
void add_points_command(CLI::App& app, int& exit_code);
void add_compare_command(CLI::App& app, int& exit_code);

}  // namespace pharos

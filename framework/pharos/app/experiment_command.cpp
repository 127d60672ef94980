#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/core/threads.h>
#include <pharos/core/writable.h>
#include <pharos/experiments/runner/experiment.h>
#include <pharos/experiments/runner/results_files.h>
#include <pharos/experiments/runner/status.h>

#include "commands.h"
#include "config_options.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace pharos {
namespace {

struct ExperimentOptions {
  ConfigOptions config;
  std::string output;
  int threads = 0;
  bool quiet = false;
  bool status = false;
  bool report = false;
};

/// Fails before the work starts if its results could not be written.
void check_outputs(const ExperimentConfig& config) {
  if (!std::filesystem::exists(config.output)) return;
  for (const char* file :
       {"results.json", "report.html", "runs.csv", "measures.csv", "convergence.csv"}) {
    check_writable(std::filesystem::path(config.output) / file);
  }
}

void report(const ExperimentResults& results) {
  std::uint64_t invalid = 0;
  for (const RunRecord& run : results.records) invalid += run.invalid_paths;
  if (invalid > 0) {
    log_warning(
        fmt::format("{} paths had NaN or infinite values and count as black: see the table "
                    "'invalid paths'",
                    invalid));
  }
  if (!results.failed.empty()) {
    log_warning(fmt::format("{} failed: {}", results.failed.size(), quoted_list(results.failed)));
  }
  log_info(fmt::format("{}: {} of {} runs{}", (results.folder() / "report.html").string(),
                       results.records.size(), results.run_count,
                       results.stopped ? " (interrupted; the same command goes on)" : ""));
}

/// Returns the command by which this program makes a run in a process of its own.
std::vector<std::string> run_program(const ExperimentOptions& options) {
  std::vector<std::string> command{std::filesystem::canonical("/proc/self/exe").string(),
                                   "experiment-run", "--threads", std::to_string(options.threads)};
  if (options.quiet) command.push_back("--quiet");
  return command;
}

/// Writes the report of the runs that are done.
int write_report(const ExperimentConfig& config, ExperimentPlan plan) {
  const ExperimentResults results = collect_results(config, std::move(plan), log_warning);
  if (results.records.empty()) {
    throw InputError(fmt::format("{}: error: no run of this experiment is done", config.output));
  }
  write_results(results);
  report(results);
  return kDone;
}

int run(const ExperimentOptions& options) {
  set_log_quiet(options.quiet);
  const Registry registry = load_default_modules();
  ExperimentConfig config =
      load_experiment(options.config.path, options.config.overrides, registry);
  if (!options.output.empty()) config.output = options.output;
  ExperimentPlan plan = plan_experiment(config, registry);
  if (options.status) {
    fmt::print("{}", to_text(experiment_status(config, plan)));
    return kDone;
  }
  check_outputs(config);
  if (options.report) return write_report(config, std::move(plan));

  const InterruptGuard interrupt;
  const ExperimentResults results = [&] {
    ProgressBar bar;
    ExperimentControl control;
    control.render.stop = &interrupt.flag();
    if (!options.quiet) control.render.on_progress = [&bar](const Progress& p) { bar.show(p); };
    control.on_message = [&bar](const std::string& message) {
      bar.clear();
      log_info(message);
    };
    control.on_warning = [&bar](const std::string& message) {
      bar.clear();
      log_warning(message);
    };
    control.run_program = run_program(options);
    return run_experiment(config, std::move(plan), registry, control);
  }();
  // Without references, nothing is measured and there are no records. Earlier results are then
  // kept.
  if (!results.records.empty()) write_results(results);
  report(results);
  if (results.stopped) return kInterrupted;
  return results.failed.empty() ? kDone : kFailed;
}

}  // namespace

void add_experiment_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("experiment", "Compare methods on scenes, and report");
  const auto options = std::make_shared<ExperimentOptions>();
  options->config.add_to(*command, "Experiment (YAML)");
  command->add_option("-o,--output", options->output, "Folder instead of the experiment's");
  command->add_option("--threads", options->threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
  CLI::Option* status = command->add_flag(
      "--status", options->status, "Only print what is done, running, failed and left to do");
  command->add_flag("--report", options->report, "Only write the report of the runs that are done")
      ->excludes(status);
  command->add_flag("-q,--quiet", options->quiet, "Only warnings and errors");
  command->callback([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = run(*options); });
  });
}

}  // namespace pharos

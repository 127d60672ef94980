#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/log.h>
#include <pharos/core/threads.h>
#include <pharos/core/writable.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/laboratory/integrands/add_integrands.h>
#include <pharos/laboratory/laboratory.h>

#include "commands.h"
#include "config_options.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace pharos {
namespace {

using laboratory::LaboratoryConfig;
using laboratory::LaboratoryResults;

struct ConvergenceOptions {
  ConfigOptions config;
  std::string output;
  int threads = 0;
  bool quiet = false;
};

/// Fails before the work starts if its results could not be written.
void check_outputs(const LaboratoryConfig& config) {
  if (!std::filesystem::exists(config.output)) return;
  for (const char* file : {"results.json", "report.html", "variances.csv"}) {
    check_writable(std::filesystem::path(config.output) / file);
  }
}

LaboratoryResults measure(const LaboratoryConfig& config, bool quiet,
                          const std::atomic<bool>& stop) {
  ProgressBar bar;
  laboratory::LaboratoryControl control;
  control.stop = &stop;
  if (!quiet) {
    control.on_progress = [&bar](double fraction, double seconds) { bar.show(fraction, seconds); };
  }
  return laboratory::measure(config, control);
}

void report(const LaboratoryResults& results) {
  fmt::print("{}", text_tables(results));
  const std::filesystem::path page = std::filesystem::path(results.config.output) / "report.html";
  log_info(fmt::format("{}: {} points at most, in {:.1f} s{}", page.string(),
                       results.numbers.back(), results.seconds,
                       results.stopped ? " (interrupted)" : ""));
}

int run(const ConvergenceOptions& options) {
  set_log_quiet(options.quiet);
  Registry registry = load_default_modules();
  laboratory::add_integrands(registry);
  LaboratoryConfig config =
      laboratory::load_laboratory(options.config.path, options.config.overrides, registry);
  if (!options.output.empty()) config.output = options.output;
  check_outputs(config);
  for (const std::string& name : config.left_out) {
    log_info(fmt::format("sampler '{}' is left out: it needs settings or a scene", name));
  }
  const FileLock lock = claim_folder(config.output, config.source);
  const InterruptGuard interrupt;
  const LaboratoryResults results = measure(config, options.quiet, interrupt.flag());
  if (results.numbers.empty()) {
    log_info("interrupted before there were results; nothing is written");
    return kInterrupted;
  }
  write_results(results);
  report(results);
  return results.stopped ? kInterrupted : kDone;
}

}  // namespace

void add_convergence_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "convergence", "Measure how fast samplers converge on integrands of known value, and report");
  const auto options = std::make_shared<ConvergenceOptions>();
  options->config.add_to(*command, "Samplers and integrands (YAML)");
  command->add_option("-o,--output", options->output, "Folder instead of the config's");
  command->add_option("--threads", options->threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command->add_flag("-q,--quiet", options->quiet, "Only the tables, warnings and errors");
  command->callback([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = run(*options); });
  });
}

}  // namespace pharos

#include <CLI/CLI.hpp>

#include <pharos/config/module_loader.h>
#include <pharos/core/log.h>
#include <pharos/core/threads.h>
#include <pharos/experiments/runner/run_order.h>

#include "commands.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace pharos {
namespace {

struct RunOptions {
  std::string order;
  int threads = 0;
  bool quiet = false;
};

int run(const RunOptions& options) {
  set_log_quiet(options.quiet);
  const InterruptGuard interrupt;
  const Registry registry = load_default_modules();
  ProgressBar bar;
  RenderControl control;
  control.stop = &interrupt.flag();
  if (!options.quiet) control.on_progress = [&bar](const Progress& p) { bar.show(p); };
  return carry_out(load_order(options.order), registry, control) ? kDone : kInterrupted;
}

}  // namespace

void add_experiment_run_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("experiment-run", "Make a run or a part of a reference");
  command->group("");  // only `pharos experiment` calls it
  const auto options = std::make_shared<RunOptions>();
  command->add_option("order", options->order, "File that describes the work")->required();
  command->add_option("--threads", options->threads, "Number of threads; 0: all cores");
  command->add_flag("-q,--quiet", options->quiet, "Only warnings and errors");
  command->callback([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = run(*options); });
  });
}

}  // namespace pharos

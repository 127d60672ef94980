#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/conformance.h>
#include <pharos/core/atomic_file.h>
#include <pharos/core/threads.h>
#include <pharos/core/writable.h>

#include "commands.h"

namespace pharos {
namespace {

using conformance::Finding;
using conformance::Verdict;

struct ConformanceOptions {
  conformance::Selection selection;
  std::string json;
  int threads = 0;
  bool all = false;
};

/// The totals of the checks of one plugin.
struct Tally {
  std::size_t checks = 0, failed = 0, not_applicable = 0;
  double smallest_p = 1;
};

Tally tally_of(const conformance::Report& report, const std::pair<std::string, std::string>& who) {
  Tally tally;
  for (const Finding& f : report.findings) {
    if (f.contract != who.first || f.plugin != who.second) continue;
    ++tally.checks;
    if (f.verdict == Verdict::failed) ++tally.failed;
    if (f.verdict == Verdict::not_applicable) ++tally.not_applicable;
    tally.smallest_p = std::min(tally.smallest_p, f.adjusted_p);
  }
  return tally;
}

void print(const Finding& f, const char* verdict) {
  const std::string p = f.p_value ? fmt::format(" (adjusted p {:.2g})", f.adjusted_p) : "";
  fmt::print("{} {} '{}' {}: {}{}\n    {}\n", verdict, f.contract, f.plugin, f.settings, f.check, p,
             f.detail);
}

void print(const conformance::Report& report, bool all) {
  for (const auto& [who, seconds] : report.seconds) {
    const Tally tally = tally_of(report, who);
    fmt::print(
        "{:<6} {:<8} {:<20} {:>4} checks, {:>2} not applicable, worst adjusted p {:<8.2g} "
        "{:.1f} s\n",
        tally.failed > 0 ? "FAILED" : "ok", who.first, who.second, tally.checks,
        tally.not_applicable, tally.smallest_p, seconds);
  }
  for (const Finding& f : report.findings) {
    if (f.verdict == Verdict::failed) print(f, "\nFAILED:");
    if (all && f.verdict == Verdict::not_applicable) print(f, "\nnot applicable:");
    if (all && f.verdict == Verdict::passed) print(f, "\nok:");
  }
}

int check(const ConformanceOptions& options) {
  check_writable(options.json);
  const Registry registry = load_default_modules();
  const conformance::Report report = conformance::check_plugins(registry, options.selection);
  print(report, options.all);
  if (!options.json.empty()) write_text_atomically(options.json, to_json(report));
  return report.passed() ? kDone : kFailed;
}

}  // namespace

void add_conformance_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("conformance", "Test plugins by the suites of their contracts");
  const auto options = std::make_shared<ConformanceOptions>();
  command->add_option("names", options->selection.names, "Contracts or plugins; none: all");
  command->add_option("--module", options->selection.module, "Only plugins of this module");
  command->add_option("--json", options->json, "Write every finding to this file");
  command->add_option("--threads", options->threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--all", options->all, "Print every finding, not only failures");
  command->callback([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = check(*options); });
  });
}

}  // namespace pharos

// Runs groups of benchmarks and prints a table. Writes the results as JSON and compares them with
// earlier results on request.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>

#include "bench.h"
#include "cluster_plots.h"
#include "growth_plots.h"
#include "results_file.h"

namespace pharos::bench {

double Measurement::median() const {
  std::vector<double> sorted = runs;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return n % 2 == 1 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
}
double Measurement::low() const {
  return *std::min_element(runs.begin(), runs.end());
}
double Measurement::high() const {
  return *std::max_element(runs.begin(), runs.end());
}

namespace {

struct Options {
  std::string json;
  std::string compare;
  std::string filter;
  std::string plots;
  int repeats = 5;
  double learning_seconds = 4;
};

std::string line(const Measurement& m) {
  return fmt::format("{:<44} {:>10.4g} {:<10} ({:.4g} to {:.4g}, {} runs)", m.name, m.median(),
                     m.unit, m.low(), m.high(), m.runs.size());
}

std::vector<Group> all_groups(const Options& options) {
  std::vector<Group> groups{{"startup", bench_startup},
                            {"rays", bench_rays},
                            {"threads", bench_threads},
                            {"samplers", bench_samplers},
                            {"growth", bench_growth},
                            {"guiding_growth", bench_guiding_growth},
                            {"aligned", bench_aligned},
                            {"gaussians", bench_gaussians},
                            {"baselines", bench_baselines},
                            {"records", bench_records},
                            {"terminations", bench_terminations}};
  const auto registry = std::make_shared<const Registry>(load_default_modules());
  groups.push_back(learning_group(registry, options.learning_seconds));
  groups.push_back(clusters_group(registry));
  for (const auto& more :
       {guiding_groups(registry), triplets_groups(registry, options.learning_seconds)}) {
    groups.insert(groups.end(), more.begin(), more.end());
  }
  return groups;
}

int run(const Options& options) {
  const OldResults old = options.compare.empty() ? OldResults() : read_results(options.compare);
  std::vector<Measurement> all;
  for (const auto& [name, benchmark] : all_groups(options)) {
    if (!options.filter.empty() && name.find(options.filter) == std::string::npos) continue;
    const auto start = std::chrono::steady_clock::now();
    for (Measurement& m : benchmark(options.repeats)) {
      fmt::print("{}\n", old.empty() ? line(m) : comparison_line(m, old));
      std::fflush(stdout);
      all.push_back(std::move(m));
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    fmt::print(stderr, "group {}: {:.0f} s\n", name, taken.count());
  }
  if (!options.json.empty()) write_results(options.json, all);
  if (!options.plots.empty()) {
    write_growth_plots(options.plots, all);
    write_cluster_plots(options.plots, all);
  }
  return 0;
}

}  // namespace
}  // namespace pharos::bench

int main(int argc, char** argv) {
  CLI::App app("Benchmarks of Pharos");
  pharos::bench::Options options;
  app.add_option("--json", options.json, "Write the results as JSON");
  app.add_option("--compare", options.compare,
                 "Print old and new medians and the ratio new / old with its interval of 95 %, for "
                 "results that --json has written")
      ->check(CLI::ExistingFile);
  app.add_option("--filter", options.filter, "Only groups whose name contains this");
  app.add_option(
         "--plots", options.plots,
         "Draw how costs grow, and the simulated efficiency on many machines, as SVG files in "
         "this folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--repeats", options.repeats, "How often to measure each figure")
      ->check(CLI::Range(1, 100));
  app.add_option("--learning-seconds", options.learning_seconds,
                 "Budget of each render of the groups 'learning' and 'triplets.SCENE', training "
                 "included [s]")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    return pharos::bench::run(options);
  } catch (const pharos::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}

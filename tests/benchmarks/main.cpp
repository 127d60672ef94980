// Runs all benchmarks, prints a table, and writes JSON on request:
// {"name": {"value": median, "unit": …, "runs": n, "low": …, "high": …}, …}

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench.h"

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

std::string json_text(const std::vector<Measurement>& all) {
  std::string text = "{\n";
  for (const Measurement& m : all) {
    text += fmt::format(
        "  \"{}\": {{\"value\": {:.6g}, \"unit\": \"{}\", \"runs\": {}, \"low\": {:.6g}, "
        "\"high\": {:.6g}}}{}\n",
        m.name, m.median(), m.unit, m.runs.size(), m.low(), m.high(), &m == &all.back() ? "" : ",");
  }
  return text + "}\n";
}

struct Options {
  std::string json;
  std::string filter;
  int repeats = 5;
};

int run(const Options& options) {
  const std::vector<std::pair<std::string, Benchmark>> benchmarks{
      {"startup", bench_startup},  {"rays", bench_rays},           {"threads", bench_threads},
      {"guiding", bench_guiding},  {"samplers", bench_samplers},   {"growth", bench_growth},
      {"aligned", bench_aligned},  {"gaussians", bench_gaussians}, {"baselines", bench_baselines},
      {"triplets", bench_triplets}};
  std::vector<Measurement> all;
  for (const auto& [name, benchmark] : benchmarks) {
    if (!options.filter.empty() && name.find(options.filter) == std::string::npos) continue;
    for (Measurement& m : benchmark(options.repeats)) {
      fmt::print("{:<40} {:>10.4g} {:<10} ({:.4g} to {:.4g}, {} runs)\n", m.name, m.median(),
                 m.unit, m.low(), m.high(), m.runs.size());
      std::fflush(stdout);
      all.push_back(std::move(m));
    }
  }
  if (options.json.empty()) return 0;
  std::ofstream out(options.json);
  out << json_text(all);
  if (out.good()) return 0;
  fmt::print(stderr, "{}: error: cannot be written\n", options.json);
  return 2;
}

}  // namespace
}  // namespace pharos::bench

int main(int argc, char** argv) {
  CLI::App app("Benchmarks of Pharos");
  pharos::bench::Options options;
  app.add_option("--json", options.json, "Write the results as JSON");
  app.add_option("--filter", options.filter, "Only groups whose name contains this");
  app.add_option("--repeats", options.repeats, "How often to measure each figure")
      ->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);
  try {
    return pharos::bench::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}

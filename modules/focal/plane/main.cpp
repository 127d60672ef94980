// pharos-focal-plane: reproduces figure 8 of Rath et al. 2023 and measures its variances (see
// README.md).
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/image.h>
#include <pharos/core/parallel.h>
#include <pharos/statistics/intervals.h>

#include "study.h"

namespace {

using namespace pharos;
using namespace pharos::focal::plane;

constexpr int kBadInput = 2, kFailed = 3;

struct Options {
  std::string output;
  std::uint64_t seed = 1;
  int seeds = 1;
  StudySettings study;
};

void add_options(CLI::App& app, Options& options) {
  StudySettings& study = options.study;
  const auto at_least = [](int least) { return CLI::Range(least, 1'000'000'000); };
  app.add_option("-o,--output", options.output, "The picture, a PNG file");
  app.add_option("--seed", options.seed, "The first seed, that of the picture")
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "How many seeds to measure")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--iterations", study.plan.iterations, "Training iterations")
      ->check(at_least(1))
      ->capture_default_str();
  app.add_option("--samples", study.plan.samples, "Samples of a training iteration")
      ->check(at_least(1))
      ->capture_default_str();
  app.add_option("--gap-width", study.scene.gap_width, "[scene units]")->capture_default_str();
  app.add_option("--light", study.scene.light_half_width, "Half the light's width [scene units]")
      ->capture_default_str();
  app.add_option("--neighbors", study.path_space.neighbors, "Paths that shape a kernel")
      ->check(at_least(2))
      ->capture_default_str();
  app.add_flag("--neighbor-means{1}", study.path_space.center,
               "Centres kernels on the mean of the neighbors, not on the guide path");
  app.add_flag("--accumulate", study.path_space.accumulate,
               "Keeps the guide paths of all iterations, not of the last one only");
}

void print_method(const std::string& name, const std::vector<SeedResult>& seeds,
                  MethodResult SeedResult::*method) {
  const auto column = [&](auto value) {
    std::vector<double> values;
    for (const SeedResult& seed : seeds) values.push_back(value(seed.*method));
    const statistics::Bounded mean = statistics::geometric_mean(values);
    return values.size() == 1 ? fmt::format("{:.2f}", mean.value)
                              : fmt::format("{:.2f} [{:.2f}, {:.2f}]", mean.value,
                                            mean.interval.low, mean.interval.high);
  };
  double sum = 0, squared_error = 0;
  for (const SeedResult& seed : seeds) {
    const MonteCarloMean& estimate = (seed.*method).estimate;
    sum += estimate.value;
    squared_error += estimate.standard_error * estimate.standard_error;
  }
  const auto count = static_cast<double>(seeds.size());
  fmt::print("{:<11} {:.5f} +- {:.5f}  {:>22} {:>22} {:>22}\n", name, sum / count,
             std::sqrt(squared_error) / count,
             column([](const MethodResult& r) { return r.efficiency; }),
             column([](const MethodResult& r) { return r.least_efficiency; }),
             column([](const MethodResult& r) { return r.worst_to_median; }));
}

void print_table(const Options& options, const std::vector<SeedResult>& seeds) {
  fmt::print("mean irradiance of the floor: {:.5f}\n", options.study.scene.mean_irradiance());
  fmt::print("{:<11} {:<19}  {:>22} {:>22} {:>22}\n", "", "estimate", "efficiency",
             "where it is least", "worst/median variance");
  print_method("uniform", seeds, &SeedResult::uniform);
  print_method("path space", seeds, &SeedResult::path_space);
  print_method("focal", seeds, &SeedResult::focal);
}

void check_range(const char* option, double value, double least, double most) {
  if (value >= least && value <= most) return;  // false for NaN
  throw InputError(fmt::format("{}: error: expected a number from {} to {}, found {}", option,
                               least, most, value));
}

void check(const Options& options) {
  const GapScene& scene = options.study.scene;
  check_range("--gap-width", scene.gap_width, 1e-6, scene.gap_distance);
  // If the half-width of the light is below 0.6, the ends of the floor do not see it.
  check_range("--light", scene.light_half_width, 0.65, 100);
  const std::filesystem::path output = options.output;
  if (!output.empty() && output.extension() != ".png") {
    throw InputError(fmt::format("--output: error: expected a name that ends in .png, found '{}'",
                                 options.output));
  }
}

void run(const Options& options) {
  check(options);
  if (!options.output.empty()) {
    write_png(draw_seed(options.study, options.seed), options.output, 0, false);
  }
  std::vector<SeedResult> seeds(static_cast<std::size_t>(options.seeds));
  parallel_for(seeds.size(),
               [&](std::size_t i) { seeds[i] = run_seed(options.study, options.seed + i); });
  print_table(options, seeds);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Figure 8 of focal guiding: path-space and focal guiding in the plane");
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    run(options);
    return 0;
  } catch (const CLI::Success& success) {  // --help
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "pharos-focal-plane: error: {}\n", one_line(error.what()));
    return kBadInput;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pharos-focal-plane: error: {}\n", error.what());
    return kFailed;
  }
}

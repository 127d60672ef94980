#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <pharos/experiments/metrics/seed_means.h>

namespace pharos {
namespace {

/// The values of all methods. Each method has one value per seed. The seeds of a method are the
/// first ones of a method with more seeds.
using MethodValues = std::vector<std::vector<double>>;

bool has_run(const ExperimentResults& results, const std::string& scene,
             const std::string& method) {
  return std::any_of(results.records.begin(), results.records.end(), [&](const RunRecord& run) {
    return run.scene == scene && run.method == method;
  });
}

std::vector<std::uint64_t> common_seeds(const ExperimentResults& results,
                                        const std::string& scene) {
  std::vector<std::uint64_t> seeds;
  const std::vector<ExperimentMethod>& methods = results.config.methods;
  for (std::uint64_t i = 0; i < results.config.seeds; ++i) {
    const std::uint64_t seed = results.config.first_seed + i;
    const auto has_it = [&](const ExperimentMethod& method) {
      return i >= results.config.seeds_of(method) ||
             results.find(scene, method.name, seed) != nullptr ||
             !has_run(results, scene, method.name);
    };
    if (std::all_of(methods.begin(), methods.end(), has_it)) seeds.push_back(seed);
  }
  return seeds;
}

MethodValues values_of(const ExperimentResults& results, const std::string& scene,
                       const RunValue& value) {
  MethodValues values(results.config.methods.size());
  for (const std::uint64_t seed : common_seeds(results, scene)) {
    const RunRecord* baseline = results.find(scene, results.config.baseline, seed);
    for (std::size_t m = 0; m < values.size(); ++m) {
      const RunRecord* run = results.find(scene, results.config.methods[m].name, seed);
      if (run != nullptr) values[m].push_back(value(*run, baseline));
    }
  }
  return values;
}

bool is_known(std::span<const double> values) {
  return !values.empty() &&
         std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool is_positive(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
}

ReportCell cell_of(std::span<const double> values, std::span<const double> baseline,
                   bool geometric) {
  ReportCell cell;
  if (!is_known(values)) return cell;
  const bool several = values.size() > 1;
  const statistics::Bounded mean =
      geometric ? statistics::geometric_mean(values) : statistics::arithmetic_mean(values);
  cell.value = mean.value;
  if (several) cell.interval = mean.interval;
  if (!geometric || !is_known(baseline)) return cell;
  const std::size_t pairs = std::min(values.size(), baseline.size());
  const statistics::Bounded ratio =
      statistics::mean_ratio(values.first(pairs), baseline.first(pairs));
  cell.ratio = ratio.value;
  if (pairs > 1) cell.ratio_interval = ratio.interval;
  return cell;
}

std::size_t baseline_index(const ExperimentConfig& config) {
  const auto is_baseline = [&](const ExperimentMethod& m) { return m.name == config.baseline; };
  return static_cast<std::size_t>(
      std::find_if(config.methods.begin(), config.methods.end(), is_baseline) -
      config.methods.begin());
}

}  // namespace

ReportTable::Row row_over_seeds(const ExperimentResults& results, const std::string& scene,
                                bool has_ratios, const RunValue& value) {
  const MethodValues values = values_of(results, scene, value);
  const auto allows_logarithm = [](std::span<const double> v) {
    return !is_known(v) || is_positive(v);
  };
  const bool geometric = has_ratios && std::all_of(values.begin(), values.end(), allows_logarithm);
  ReportTable::Row row{scene, {}};
  for (const std::vector<double>& own : values) {
    row.cells.push_back(cell_of(own, values[baseline_index(results.config)], geometric));
  }
  return row;
}

}  // namespace pharos

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pharos/config/registry.h>

namespace pharos::bench {

/// One figure with the values of all its runs.
struct Measurement {
  std::string name;  ///< such as "rays.cornell-box.mrays"
  std::string unit;
  std::vector<double> runs;

  double median() const;
  double low() const;
  double high() const;
};

/// A group of measurements that run together. Compared measurements are interleaved. `repeats` is
/// the number of runs of each figure.
using Benchmark = std::function<std::vector<Measurement>(int repeats)>;

std::vector<Measurement> bench_rays(int repeats);
std::vector<Measurement> bench_threads(int repeats);
std::vector<Measurement> bench_startup(int repeats);
std::vector<Measurement> bench_samplers(int repeats);
std::vector<Measurement> bench_growth(int repeats);
std::vector<Measurement> bench_guiding_growth(int repeats);
std::vector<Measurement> bench_aligned(int repeats);
std::vector<Measurement> bench_gaussians(int repeats);
std::vector<Measurement> bench_baselines(int repeats);
std::vector<Measurement> bench_records(int repeats);
std::vector<Measurement> bench_terminations(int repeats);

/// A group with the name by which `--filter` selects it.
struct Group {
  std::string name;
  Benchmark run;
};
/// Returns a group for every registered pair of a learner and a guider whose models match.
std::vector<Group> guiding_groups(const std::shared_ptr<const Registry>& registry);
/// Returns a group with the share of updates in the training of each learner, in renders with a
/// budget of `seconds`.
Group learning_group(const std::shared_ptr<const Registry>& registry, double seconds);
/// Returns a group with the rates of learning on many machines, and simulated efficiencies.
Group clusters_group(const std::shared_ptr<const Registry>& registry);
/// Returns a group for the parts of vertex triplets and one for each scene. Renders of the scenes
/// have a budget of `seconds`.
std::vector<Group> triplets_groups(const std::shared_ptr<const Registry>& registry, double seconds);

}  // namespace pharos::bench

#pragma once

#include <functional>
#include <string>
#include <vector>

#include <pharos/experiments/runner/experiment_config.h>
#include <pharos/experiments/runner/plan.h>
#include <pharos/experiments/runner/reference.h>
#include <pharos/experiments/runner/run_record.h>

/// Experiments: every method on every scene with every seed, measured against a reference.
///
///     const ExperimentConfig config = load_experiment(path, {}, registry);
///     ExperimentPlan plan = plan_experiment(config, registry);
///     const ExperimentResults results = run_experiment(config, std::move(plan), registry,
///     control); write_results(results);
///
/// Runs are made one after the other, each on all threads; of a seed all scenes, of a scene all
/// methods, so that what disturbs the machine disturbs all methods alike. Each finished run leaves
/// a record in the output folder; those that are there and would come out the same are not made
/// again, so an experiment that was stopped goes on where it stood.
namespace pharos {

/// How an experiment is watched and stopped.
struct ExperimentControl {
  RenderControl render;                                ///< of each render; `on_pass` is not used
  std::function<void(const std::string&)> on_message;  ///< a line about what is done or comes next
};

/// What an experiment has found so far.
struct ExperimentResults {
  ExperimentConfig config;
  ExperimentPlan plan;
  std::vector<Reference> references;  ///< one a scene; fewer when it was stopped before
  std::vector<RunRecord> records;     ///< all that are known, in the order of the runs
  std::size_t run_count = 0;          ///< of the whole experiment
  bool stopped = false;

  std::filesystem::path folder() const { return config.output; }
  /// Where a file of a run stands, such as "output/runs/cornell-box/sobol/seed-1" + extension.
  std::filesystem::path run_file(const std::string& scene, const std::string& method,
                                 std::uint64_t seed, const std::string& extension) const;
  /// The record of a run; null when there is none.
  const RunRecord* find(const std::string& scene, const std::string& method,
                        std::uint64_t seed) const;
};

/// Renders what is missing. Throws InputError when another experiment has used the output folder,
/// or uses it now.
ExperimentResults run_experiment(const ExperimentConfig& config, ExperimentPlan plan,
                                 const Registry& registry, const ExperimentControl& control);

}  // namespace pharos

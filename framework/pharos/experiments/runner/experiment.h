#pragma once

#include <functional>
#include <optional>
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
///     const ExperimentResults results =
///         run_experiment(config, std::move(plan), registry, control);
///     write_results(results);
///
/// Runs are made one after the other, each on all threads: seed by seed, then scene by scene, then
/// method by method. If the machine is disturbed for a while, all methods are affected alike. Each
/// finished run leaves a record in the output folder. A run is skipped if its record exists and the
/// run would give the same result, so an experiment that was stopped can be resumed. A run whose
/// record or images were damaged or changed is made again. A run that fails ends nothing but
/// itself.
///
/// Several processes, also on other machines, may run the same experiment in the same folder at the
/// same time. Each makes runs that no other process makes (see ClaimBoard), and ends when there are
/// no more. Runs with a time budget are made one at a time on a machine.
namespace pharos {

/// Callbacks that observe and stop an experiment.
struct ExperimentControl {
  RenderControl render;  ///< control of each render; `on_pass` is not used
  std::function<void(const std::string&)> on_message;  ///< progress messages
  std::function<void(const std::string&)> on_warning;  ///< what failed or was damaged
  /// The program and arguments that make a run or a part of a reference, see carry_out(). The path
  /// of the file that save_order() writes is added as the last argument. If the list is empty, this
  /// process makes both itself.
  std::vector<std::string> run_program;
};

/// The results of an experiment so far.
struct ExperimentResults {
  ExperimentConfig config;
  ExperimentPlan plan;
  /// One per scene. None for a scene whose reference failed, or is not there yet; it has no runs.
  std::vector<std::optional<Reference>> references;
  std::vector<RunRecord> records;  ///< all known records, in the order of the runs
  std::size_t run_count = 0;       ///< number of runs of the whole experiment
  bool stopped = false;
  std::vector<std::string> failed;  ///< runs and references that failed, by name

  std::filesystem::path folder() const { return config.output; }
  /// Returns the record of a run; null if there is none.
  const RunRecord* find(const std::string& scene, const std::string& method,
                        std::uint64_t seed) const;
};

/// Returns the results that an experiment has so far, and renders nothing. References and records
/// that do not exist yet are missing.
ExperimentResults collect_results(const ExperimentConfig& config, ExperimentPlan plan,
                                  const std::function<void(const std::string&)>& on_warning);

/// Renders the missing runs. Throws InputError if another experiment has used the output folder, or
/// if a process with other configs is using it.
ExperimentResults run_experiment(const ExperimentConfig& config, ExperimentPlan plan,
                                 const Registry& registry, const ExperimentControl& control);

}  // namespace pharos

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <pharos/experiments/runner/experiment_config.h>
#include <pharos/experiments/runner/plan.h>
#include <pharos/experiments/runner/run_record.h>

namespace pharos {

/// One method on one scene with one seed.
struct PlannedRun {
  const PlannedCell* cell = nullptr;
  std::uint64_t seed = 0;
  std::string scene, method;
  std::string key;  ///< see RunRecord::key
  bool is_timed = false;
  bool keeps_image = false;

  /// Returns the run in words.
  std::string name() const;
  /// Returns the name under which processes claim the run.
  std::string claim_name() const;
};

/// Returns all runs of a plan in the order of execution: seed by seed, then scene by scene, then
/// method by method. Both objects must outlive them.
std::vector<PlannedRun> planned_runs(const ExperimentConfig& config, const ExperimentPlan& plan);

/// Returns a key of everything that a process must agree on with others to make runs together: the
/// configs, the code and, if time counts, the type of machine.
std::string plan_key(const ExperimentConfig& config, const ExperimentPlan& plan);

/// Returns the path of a file of a run: "FOLDER/runs/SCENE/METHOD/seed-N" + extension.
std::filesystem::path run_file(const std::filesystem::path& folder, const std::string& scene,
                               const std::string& method, std::uint64_t seed,
                               const std::string& extension);

/// The files of an experiment's runs.
class RunFiles {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// The folder holds the results of an experiment. `warn` receives what was damaged.
  RunFiles(std::filesystem::path folder, Warn warn)
      : folder_(std::move(folder)), warn_(std::move(warn)) {}

  std::filesystem::path file(const PlannedRun& run, const std::string& extension) const {
    return run_file(folder_, run.scene, run.method, run.seed, extension);
  }
  /// Returns the record of an earlier run with the same key, if its files are as the run left them.
  std::optional<RunRecord> load(const PlannedRun& run) const;
  /// Does the same for a process that has claimed the run: it sees what earlier owners on other
  /// machines have written, says what is damaged, and moves a damaged record aside.
  std::optional<RunRecord> take_over(const PlannedRun& run) const;
  /// Returns the record of an earlier run with the same key as it is, without a look at its images.
  std::optional<RunRecord> peek(const PlannedRun& run) const;
  /// Removes what an earlier run has left.
  void clear(const PlannedRun& run) const;

  /// Notes for all processes that the run has failed.
  void save_failure(const PlannedRun& run, const std::string& reason) const;
  /// Returns why the run has failed; none if it has not.
  std::optional<std::string> failure(const PlannedRun& run) const;
  void forget_failure(const PlannedRun& run) const;

 private:
  /// The files of an earlier run, as far as they are sound.
  struct Remains {
    std::optional<RunRecord> record;
    std::string problem;      ///< why there is no record that counts; empty if there was none
    bool is_damaged = false;  ///< the file of the record itself cannot be read
  };
  Remains examine(const PlannedRun& run) const;

  std::filesystem::path folder_;
  Warn warn_;
};

}  // namespace pharos

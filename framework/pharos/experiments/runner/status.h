#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pharos/experiments/runner/experiment_config.h>
#include <pharos/experiments/runner/plan.h>

namespace pharos {

/// The state of an experiment on which processes may be at work.
struct ExperimentStatus {
  struct Work {
    std::string name;
    std::string host;
    std::int64_t process = 0;
    double seconds = 0;  ///< since it began, if the clocks of the machines agree
  };
  struct Failure {
    std::string run, reason;
  };

  std::size_t run_count = 0, done = 0;
  std::size_t processes = 0;     ///< that are at work
  std::vector<Work> running;     ///< runs
  std::vector<Work> references;  ///< parts of references that are rendered now
  std::vector<Failure> failed;
  /// Expected time until all runs are done [s], from the time that runs took so far; none if
  /// nothing is known of it.
  std::optional<double> seconds_left;
};

/// Looks at the folder of an experiment. It may be called at any time, on any of the machines.
ExperimentStatus experiment_status(const ExperimentConfig& config, const ExperimentPlan& plan);

/// Returns a status as a few lines of text.
std::string to_text(const ExperimentStatus& status);

}  // namespace pharos

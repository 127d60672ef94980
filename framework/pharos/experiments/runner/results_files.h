#pragma once

#include <pharos/experiments/report/report.h>
#include <pharos/experiments/runner/experiment.h>

namespace pharos {

/// One line a run: all errors, times and sizes.
std::string runs_csv(const ExperimentResults& results);
/// One line a checkpoint.
std::string convergence_csv(const ExperimentResults& results);

/// The report of what there is so far: tables, curves, the first seed's images, pictures of learned
/// densities and the exact configs.
Report experiment_report(const ExperimentResults& results);

/// Writes results.json, runs.csv, convergence.csv and report.html into the output folder; each file
/// appears whole or not at all. Throws RunError.
void write_results(const ExperimentResults& results);

}  // namespace pharos

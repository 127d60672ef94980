#pragma once

#include <map>
#include <set>
#include <string>

#include <pharos/experiments/report/report.h>
#include <pharos/experiments/runner/experiment.h>

namespace pharos {

/// Returns CSV with one line per run: all errors, times and sizes.
std::string runs_csv(const ExperimentResults& results);
/// Returns CSV with one line per run and measure. Unknown values have no line.
std::string measures_csv(const ExperimentResults& results);
/// Returns CSV with one line per checkpoint.
std::string convergence_csv(const ExperimentResults& results);

/// Returns the papers to cite for each method that has some, over all scenes (see Registry::add).
std::map<std::string, std::set<std::string>> papers_by_method(const ExperimentResults& results);

/// Returns the report of the results so far: tables, curves, the first seed's images, pictures of
/// learned densities and the exact configs.
Report experiment_report(const ExperimentResults& results);

/// Writes results.json, runs.csv, measures.csv, convergence.csv and report.html into the output
/// folder. Each file is written completely or not at all. Throws RunError.
void write_results(const ExperimentResults& results);

}  // namespace pharos

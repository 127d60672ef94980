#pragma once

#include <vector>

#include <pharos/experiments/report/report.h>
#include <pharos/experiments/runner/experiment.h>

namespace pharos {

/// Returns a table for every measure of the runs: error metrics, seconds, samples, rays and memory,
/// as means over seeds by row_over_seeds(). Decibels and measures that may be zero have arithmetic
/// means.
std::vector<ReportTable> summary_tables(const ExperimentResults& results);

/// Returns the errors of the checkpoints over samples per pixel and over seconds. Points are
/// geometric means over seeds, with intervals if there are several seeds. If seeds stopped at
/// different places, the errors in between are interpolated on logarithmic axes. A slope is the
/// mean of the seeds' slopes over the work of the final image, without training.
std::vector<ReportCurve> convergence_curves(const ExperimentResults& results);

/// Returns the time after which each method's relMSE stays below the final relMSE of the baseline
/// with the same seed. A method has no value if one of its seeds does not reach it.
ReportTable equal_error_table(const ExperimentResults& results);

}  // namespace pharos

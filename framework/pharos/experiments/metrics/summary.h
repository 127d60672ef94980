#pragma once

#include <vector>

#include <pharos/experiments/report/report.h>
#include <pharos/experiments/runner/experiment.h>

namespace pharos {

/// Tables of every measure that the runs know: error metrics, seconds, samples, rays, memory, means
/// over seeds by row_over_seeds(). Decibels and what may be zero have arithmetic means.
std::vector<ReportTable> summary_tables(const ExperimentResults& results);

/// Errors over samples a pixel and over seconds, of the checkpoints' metrics: geometric means over
/// seeds, with intervals where there are several. Where seeds stopped at other places, errors in
/// between are interpolated on logarithmic axes. A slope is the mean of the seeds' slopes over the
/// work of the final image, training left out.
std::vector<ReportCurve> convergence_curves(const ExperimentResults& results);

/// The time after which each method's relMSE stays below what the baseline has at its end with the
/// same seed; none for a method of which a seed does not reach it.
ReportTable equal_error_table(const ExperimentResults& results);

}  // namespace pharos

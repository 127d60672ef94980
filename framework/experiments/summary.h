#pragma once

#include <vector>

#include <pharos/experiments/experiment.h>
#include <pharos/experiments/report.h>

namespace pharos {

/// Tables of every measure that the runs know: error metrics, seconds, samples, rays, memory. A
/// cell is the geometric mean over seeds with its 95 % interval, and the geometric mean of its
/// ratio to the baseline of the same seed; measures that may be zero or on a logarithmic scale have
/// arithmetic means and no ratio.
std::vector<ReportTable> summary_tables(const ExperimentResults& results);

/// Errors over samples a pixel and over seconds, of the checkpoints' metrics: geometric means over
/// seeds, with intervals where there are several. Where seeds stopped at other places, errors in
/// between are interpolated on logarithmic axes. A slope is the mean of the seeds' slopes.
std::vector<ReportCurve> convergence_curves(const ExperimentResults& results);

/// The time after which each method's relMSE stays below what the baseline has at its end, from the
/// convergence curves; none for a method that does not reach it.
ReportTable equal_error_table(const ExperimentResults& results,
                              const std::vector<ReportCurve>& curves);

}  // namespace pharos

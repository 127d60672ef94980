#pragma once

#include <functional>
#include <string>

#include <pharos/experiments/report/report.h>
#include <pharos/experiments/runner/experiment.h>

namespace pharos {

/// What is told of a run, given the baseline's run of the same scene and seed, which may be null;
/// NaN for nothing.
using RunValue = std::function<double(const RunRecord& run, const RunRecord* baseline)>;

/// The means of a scene's runs, method by method, over the seeds that all methods have; others
/// could not be compared. With `has_ratios` they are geometric, with the geometric mean of the
/// ratios to the baseline of the same seed, provided that all values of the row are positive; else
/// arithmetic. A method with a value that is not finite has none. Intervals of 95 % where there are
/// several seeds.
ReportTable::Row row_over_seeds(const ExperimentResults& results, const std::string& scene,
                                bool has_ratios, const RunValue& value);

}  // namespace pharos

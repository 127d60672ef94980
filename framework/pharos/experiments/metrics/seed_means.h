#pragma once

#include <functional>
#include <string>

#include <pharos/experiments/report/report.h>
#include <pharos/experiments/runner/experiment.h>

namespace pharos {

/// Returns a value of `run`. `baseline` is the baseline's run of the same scene and seed, or null.
/// NaN means that there is no value.
using RunValue = std::function<double(const RunRecord& run, const RunRecord* baseline)>;

/// Returns one row of a table: for each method the mean of a scene's runs. Only those seeds count
/// that all methods have, except methods without any run of the scene, because other seeds could
/// not be compared. A method that is to have fewer seeds than others is asked for its own only.
///
/// With `has_ratios`, and if all values of the row are positive, the means are geometric and come
/// with the geometric mean of the ratios to the baseline of the same seed. Otherwise the means are
/// arithmetic. A method with a value that is not finite has no mean. If there are several seeds,
/// means and ratios have 95 % intervals.
ReportTable::Row row_over_seeds(const ExperimentResults& results, const std::string& scene,
                                bool has_ratios, const RunValue& value);

}  // namespace pharos

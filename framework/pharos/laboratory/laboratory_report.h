#pragma once

#include <string>

#include <pharos/experiments/report/report.h>
#include <pharos/laboratory/laboratory.h>

namespace pharos::laboratory {

/// Returns the report page of the results. Its methods are the samplers, and its scenes are the
/// integrands.
Report laboratory_report(const LaboratoryResults& results);

/// Returns every variance with its interval as CSV, one line each.
std::string variances_csv(const LaboratoryResults& results);

}  // namespace pharos::laboratory

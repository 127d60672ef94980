#pragma once

#include <string>

#include <pharos/experiments/report/report.h>
#include <pharos/laboratory/laboratory.h>

namespace pharos::laboratory {

/// The report page of the results: samplers are its methods, integrands its scenes.
Report laboratory_report(const LaboratoryResults& results);

/// Every variance with its interval, one line each, as CSV.
std::string variances_csv(const LaboratoryResults& results);

}  // namespace pharos::laboratory

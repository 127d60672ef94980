#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench.h"

namespace pharos::bench {

/// The values of each figure by its name.
using OldResults = std::map<std::string, std::vector<double>>;

/// Writes figures as JSON: {"name": {"unit": …, "value": median, "runs": [values]}, …}. Throws
/// RunError if the file cannot be written.
void write_results(const std::string& file, const std::vector<Measurement>& all);

/// Reads what write_results() wrote. Throws InputError if the file is missing or of another form.
OldResults read_results(const std::string& file);

/// Returns a line with the old median of a figure, its new median, and the ratio of its geometric
/// means, new over old. The 95 % confidence interval of the ratio follows in brackets. A star at
/// the end means that this interval does not contain 1.
std::string comparison_line(const Measurement& now, const OldResults& old);

}  // namespace pharos::bench

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

/// Returns the line of a figure in a comparison: its old and new medians, and the ratio new / old
/// of the geometric means with its interval of 95 %. A star marks a ratio whose interval does not
/// contain 1.
std::string comparison_line(const Measurement& now, const OldResults& old);

}  // namespace pharos::bench

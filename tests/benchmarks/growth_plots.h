#pragma once

#include <filesystem>
#include <vector>

#include "bench.h"

namespace pharos::bench {

/// Draws every group of figures growth.PARAMETER.VALUE.FIGURE that differ in VALUE alone, as
/// growth-PARAMETER-FIGURE.svg in `folder`. Both axes are logarithmic. Throws RunError if a file
/// cannot be written.
void write_growth_plots(const std::filesystem::path& folder, const std::vector<Measurement>& all);

}  // namespace pharos::bench

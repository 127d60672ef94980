#pragma once

#include <pharos/experiments/report/report.h>

namespace pharos::test {

/// Returns a report with everything that a report can contain: two scenes, three methods, curves
/// over both axes, error maps, pictures, values that are missing or infinite, and names that HTML
/// and JSON must escape.
///
/// The scene "ramp" has known values, which report_page_test.py repeats. It has 64 x 32 pixels with
/// R = (x + 1) / 64, G = (y + 1) / 32, B = 1/4, times 1 for the reference and 5/4, 3/2, 7/4 for the
/// methods. There are three exceptions: B is 70000 at (0, 0) and 2^-20, which is denormal as a
/// half, at (1, 0), and the last method's R is NaN at (5, 5). The maps of "relMSE" contain (x + 1)
/// / 2^k for the methods k = 10, 11, 12.
Report sample_report();

}  // namespace pharos::test

#pragma once

#include <vector>

#include <pharos/experiments/metrics/pixel_pair.h>

/// FLIP and HDR-FLIP a second time, as the papers state them: in double precision, every filter in
/// full as a table of two dimensions, every pixel by itself. Shares no code with flip.cpp.
namespace pharos::test {

std::vector<double> direct_flip(const PixelPair& pair, double pixels_per_degree);
std::vector<double> direct_hdr_flip(const PixelPair& pair, double pixels_per_degree);

}  // namespace pharos::test

#pragma once

#include <vector>

#include <pharos/experiments/metrics/pixel_pair.h>

/// A second implementation of FLIP and HDR-FLIP that follows the papers literally: in double
/// precision, with every filter as a full 2D table, and every pixel independently. It shares no
/// code with flip.cpp.
namespace pharos::test {

std::vector<double> direct_flip(const PixelPair& pair, double pixels_per_degree);
std::vector<double> direct_hdr_flip(const PixelPair& pair, double pixels_per_degree);

}  // namespace pharos::test

#pragma once

#include <cstdint>
#include <vector>

#include "pmj02_tables.h"

namespace pharos::pmj02 {

/// Moves the points of a sequence (2^8 of them, or another power of two of this size) apart. The
/// two halves of an interval of x or of y change places, with all points in them, wherever that
/// makes the points of aligned blocks less crowded; nets stay nets. Blocks of 4 points come first,
/// then larger ones, each with the intervals about as wide as their points lie apart. A block is
/// judged as it will be used: at places and with digits flipped that `seed` draws.
void move_apart(std::vector<Point>& points, std::uint64_t seed);

}  // namespace pharos::pmj02

#pragma once

#include <cstdint>
#include <vector>

#include "pmj02_tables.h"

namespace pharos::pmj02 {

/// Moves the points of a sequence apart, for a sequence of 2^8 points or of another power of two of
/// this size. The two halves of an interval of x or of y change places, together with all points in
/// them, if this makes the points of aligned blocks less crowded. Nets remain nets. Blocks of 4
/// points come first, larger blocks follow; the intervals of each block size are about as wide as
/// the distance between its points. A block is judged in the way it will be used: at places and
/// with flipped digits that `seed` draws.
void move_apart(std::vector<Point>& points, std::uint64_t seed);

}  // namespace pharos::pmj02

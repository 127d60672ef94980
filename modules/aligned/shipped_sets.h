#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "point_set.h"

namespace pharos::aligned {

/// Sizes of the sets that are part of the program.
inline constexpr std::array<std::uint32_t, 4> kShippedSizes{64, 256, 1024, 4096};

/// Number of free directions of these sets: 0, 1, … 45 degrees. All other directions are symmetric
/// to these.
inline constexpr int kShippedDirections = 46;

/// Returns the set of the program with this free direction [degrees] and this number of points. The
/// result is empty if there is no such set.
std::optional<PointSet> shipped_set(int direction, std::uint32_t points);

}  // namespace pharos::aligned

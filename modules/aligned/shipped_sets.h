#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "point_set.h"

namespace pharos::aligned {

/// Sizes of the sets that are part of the program.
inline constexpr std::array<std::uint32_t, 4> kShippedSizes{64, 256, 1024, 4096};

/// Free directions that they have: 0, 1, … 45 degrees. All others are symmetric to these.
inline constexpr int kShippedDirections = 46;

/// The set of this free direction [degrees] and number of points that is part of the program; none
/// where there is no such.
std::optional<PointSet> shipped_set(int direction, std::uint32_t points);

}  // namespace pharos::aligned

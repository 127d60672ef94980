#pragma once

#include <span>

#include <pharos/core/image.h>
#include <pharos/core/vec.h>
#include <pharos/statistics/point_sets.h>

/// Pictures of point sets: channels R, G, B, linear, to be written without any tone curve.
namespace pharos {

/// The unit square as a sheet of paper, x to the right, y up, a dark disk on each point. Disks are
/// small enough for evenly spread points to stay apart.
Image points_picture(std::span<const Vec2> points, int edge);

/// What spectrum_picture() shows as its first and last color; independent points have a power of
/// 1, two thirds up.
inline constexpr double kLowestPower = 0.01, kHighestPower = 10;

/// The power at all frequencies in false colors on a logarithmic scale, frequency zero in the
/// middle and itself of the lowest color, x to the right, y up.
Image spectrum_picture(const statistics::PowerSpectrum& spectrum, int edge);

/// Pictures of the size of the first in rows of `columns` each, white between them and where one is
/// empty.
Image contact_sheet(std::span<const Image> pictures, int columns);

}  // namespace pharos

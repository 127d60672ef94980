#pragma once

#include <span>

#include <pharos/core/image.h>
#include <pharos/core/vec.h>
#include <pharos/statistics/point_sets.h>

/// Pictures of point sets: linear channels R, G, B, to be written without a tone curve.
namespace pharos {

/// Draws the unit square on white with a dark disk on each point, x to the right, y up. The disks
/// are small enough that evenly spread points do not touch.
Image points_picture(std::span<const Vec2> points, int edge);

/// The powers of the first and the last color of spectrum_picture(). Independent points have a
/// power of 1, which is two thirds up the scale.
inline constexpr double kLowestPower = 0.01, kHighestPower = 10;

/// Draws the power at all frequencies in false colors on a logarithmic scale, x to the right, y up.
/// Frequency zero is in the middle and has the lowest color.
Image spectrum_picture(const statistics::PowerSpectrum& spectrum, int edge);

/// Arranges pictures in rows of `columns` each. All have the size of the first picture. The gaps
/// between them and empty places are white.
Image contact_sheet(std::span<const Image> pictures, int columns);

}  // namespace pharos

#pragma once

#include <pharos/core/image.h>

namespace pharos {

/// The range of values that false_color() shows, and its scale.
struct ColorScale {
  double low = 0, high = 1;  ///< values of the first and the last color
  bool logarithmic = false;  ///< if true, low and high must be positive
};

/// Returns the position of a value on the scale: 0 at `low`, 1 at `high`, not clamped. Values that
/// a logarithm cannot show are at 0.
double scale_position(double value, const ColorScale& scale);

/// Maps a position from 0 to 1 to a linear color of magma, by N. Smith and S. van der Walt
/// (matplotlib 1.5, 2015; CC0). The map is perceptually uniform from black over purple and orange
/// to pale yellow. It is interpolated linearly between sixteen colors, and differs from the
/// published 256 colors by at most 0.01 (sRGB-encoded). Positions outside of the range have the
/// color of the nearest end.
Rgb magma(double position);

/// The color of NaN: pure green, which magma does not contain.
inline constexpr Rgb kNanColor{0, 1, 0};

/// Returns the first channel of `map` in false colors: linear channels R, G, B, to be written
/// without a tone curve. Throws InputError unless low < high and both are finite, and positive for
/// a logarithmic scale.
Image false_color(const Image& map, const ColorScale& scale);

}  // namespace pharos

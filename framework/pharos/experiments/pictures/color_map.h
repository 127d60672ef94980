#pragma once

#include <pharos/core/image.h>

namespace pharos {

/// What false_color() shows and how.
struct ColorScale {
  double low = 0, high = 1;  ///< values that show as the first and the last color
  bool logarithmic = false;  ///< low and high must be positive then
};

/// Where a value is on the scale: 0 at `low`, 1 at `high`, not clamped. What a logarithm cannot
/// show is at 0.
double scale_position(double value, const ColorScale& scale);

/// A position on the map, 0 to 1, as a linear color: magma, by N. Smith and S. van der Walt
/// (matplotlib 1.5, 2015; CC0), perceptually uniform from black over purple and orange to pale
/// yellow. Sixteen colors and straight lines between them, never further than 0.01 from the
/// published 256 (sRGB-encoded). Positions outside show as the nearest end.
Rgb magma(double position);

/// How NaN is shown: pure green, which magma does not have.
inline constexpr Rgb kNanColor{0, 1, 0};

/// The first channel of `map` in false colors: channels R, G, B, linear, to be written without any
/// tone curve. Throws InputError unless low < high, both finite, and positive for a logarithmic
/// scale.
Image false_color(const Image& map, const ColorScale& scale);

}  // namespace pharos

#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/rgb.h>

namespace pharos {

/// CIE 1931 tristimulus values.
struct Xyz {
  double x = 0, y = 0, z = 0;

  Xyz& operator+=(Xyz c) {
    x += c.x, y += c.y, z += c.z;
    return *this;
  }
  friend Xyz operator*(double s, Xyz c) { return {s * c.x, s * c.y, s * c.z}; }
};

/// Converts chromaticity (x, y), y > 0, and luminance Y.
inline Xyz xyz_from_xyy(double x, double y, double luminance) {
  return (luminance / y) * Xyz{x, y, std::max(0.0, 1 - x - y)};
}

/// Converts to linear Rec.709. Negative channels, of colors outside its gamut, are set to zero.
inline Rgb rgb_from_xyz(Xyz c) {
  const auto channel = [](double v) { return static_cast<float>(std::max(0.0, v)); };
  return {channel(3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z),
          channel(-0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z),
          channel(0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z)};
}

/// The CIE 1931 color matching functions at a wavelength [nm] (multi-lobe fit of Wyman, Sloan and
/// Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions").
inline Xyz matching_functions(double wavelength) {
  const auto lobe = [&](double mean, double left, double right) {
    const double t = (wavelength - mean) / (wavelength < mean ? left : right);
    return std::exp(-0.5 * t * t);
  };
  return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) -
              0.065 * lobe(501.1, 20.4, 26.2),
          0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
          1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

}  // namespace pharos

#pragma once

#include <functional>

#include <pharos/core/rgb.h>

namespace pharos::importing {

/// A spectrum as a function: its value at a wavelength [nm].
using WavelengthFunction = std::function<double(double)>;

/// Returns the color of light with this spectrum, relative to light of equal power at every
/// wavelength, which has luminance 1 for the value 1. Negative components, of colors out of gamut,
/// become 0.
Rgb color_of_light(const WavelengthFunction& spectrum);

/// Returns the color of a surface or medium with this spectrum (a reflectance, a refractive index)
/// in daylight, illuminant D65. A spectrum that is 1 everywhere has the color (1, 1, 1). Negative
/// components become 0; if the spectrum never exceeds 1, neither do the components.
Rgb color_in_daylight(const WavelengthFunction& spectrum);

/// Returns the color of luminance 1 with the chromaticity (x, y) of the CIE 1931 observer. Negative
/// components become 0.
Rgb color_of_chromaticity(double x, double y);

/// Returns the radiance of a black body at an absolute temperature [K] and a wavelength [nm], by
/// Planck's law [W/(m^2 sr nm)].
double black_body(double temperature, double wavelength);

}  // namespace pharos::importing

#pragma once

#include <functional>

#include <pharos/core/rgb.h>

namespace pharos::mitsuba {

/// A spectrum: its value at a wavelength [nm].
using WavelengthFunction = std::function<double(double)>;

/// The color of light with this spectrum, relative to that of light of the same power at every
/// wavelength, whose luminance is 1 for the value 1. Not below 0: colors out of gamut lose what
/// they have too much.
Rgb color_of_light(const WavelengthFunction& spectrum);

/// The color of a surface or medium that has this spectrum (a reflectance, a refractive index) in
/// daylight, illuminant D65: a spectrum that is 1 everywhere has the color (1, 1, 1). Not below 0,
/// and not above 1 where the spectrum nowhere is.
Rgb color_in_daylight(const WavelengthFunction& spectrum);

/// Radiance of a black body at an absolute temperature [K] and a wavelength [nm], by Planck's law
/// [W/(m^2 sr nm)].
double black_body(double temperature, double wavelength);

}  // namespace pharos::mitsuba

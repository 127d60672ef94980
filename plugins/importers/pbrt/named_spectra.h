#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/core/rgb.h>

namespace pharos::pbrt {

/// A spectrum that pbrt knows by name.
struct NamedSpectrum {
  std::string_view name;  ///< "metal-Au-eta"
  Rgb value;              ///< linear Rec.709; luminance 1 for illuminants
};

/// Returns the value of a named spectrum: the complex index of a metal, the index of a glass at the
/// wavelength 587.6 nm, or the color of a standard illuminant. Empty for other names.
std::optional<Rgb> named_spectrum(std::string_view name);

/// All names, for messages.
std::vector<std::string> spectrum_names();

}  // namespace pharos::pbrt

#pragma once

#include <filesystem>
#include <optional>
#include <pbrt_syntax/parameters.h>
#include <string_view>

#include <pharos/core/rgb.h>

#include "../shared/read_file.h"

namespace pharos::pbrt {

/// The role of a color: it changes how a spectrum becomes RGB.
enum class ColorRole {
  surface,  ///< a reflectance, a refractive index, a coefficient: a factor on light
  light,    ///< emitted light
};

/// The primaries of RGB values.
enum class ColorSpace { srgb, rec2020, dci_p3, aces2065_1 };

/// Returns the color space of this name. Throws InputError, not located, for other names.
ColorSpace color_space(const std::string& name);

/// A color in linear Rec.709.
struct Color {
  Rgb value;
  bool is_gray = false;       ///< given by one number
  bool approximated = false;  ///< converted to RGB from values over wavelengths
};

/// Reads colors as pbrt-v4 shows them on a film of linear sRGB with its default sensor, the CIE
/// 1931 observer.
///
/// A light's spectrum has the luminance 1 whatever its values, because pbrt divides by it: only
/// `scale` and `power` tell how bright a light is. Other spectra are weighted by daylight (D65).
class ColorReader {
 public:
  ColorReader(const std::filesystem::path& folder, importing::ReadingBudget& budget)
      : folder_(folder), budget_(budget) {}

  /// Returns the color of a parameter of type "rgb", "spectrum", "blackbody" or "float". Throws
  /// InputError, located at the parameter, for other types, unknown names of spectra (with the
  /// nearest one), files that cannot be read, and lists that are not pairs of a wavelength and a
  /// value with increasing wavelengths.
  Color read(const Parameter& parameter, ColorRole role, ColorSpace space) const;

 private:
  Color read_spectrum(const Parameter& parameter, ColorRole role) const;

  const std::filesystem::path& folder_;
  importing::ReadingBudget& budget_;
};

}  // namespace pharos::pbrt

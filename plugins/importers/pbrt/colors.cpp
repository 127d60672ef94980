#include "colors.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "../shared/color_matching.h"
#include "../shared/spectrum_file.h"
#include "named_spectra.h"
#include "statements.h"

namespace pharos::pbrt {
namespace {

using importing::WavelengthList;
using Matrix = std::array<std::array<float, 3>, 3>;

/// Matrices to linear Rec.709, from the chromaticities of the primaries (ITU-R BT.2020, SMPTE EG
/// 432-1 with the white point D65, SMPTE ST 2065-1). The white point D60 of ACES2065-1 is mapped to
/// D65 by Bradford's method.
constexpr Matrix kFromRec2020{{{1.6604910f, -0.5876411f, -0.0728499f},
                               {-0.1245505f, 1.1328999f, -0.0083494f},
                               {-0.0181508f, -0.1005789f, 1.1187297f}}};
constexpr Matrix kFromP3{{{1.2249402f, -0.2249402f, 0},
                          {-0.0420570f, 1.0420570f, 0},
                          {-0.0196376f, -0.0786361f, 1.0982736f}}};
constexpr Matrix kFromAces{{{2.5216862f, -1.1341310f, -0.3875552f},
                            {-0.2764799f, 1.3727191f, -0.0962392f},
                            {-0.0153781f, -0.1529753f, 1.1683534f}}};

Rgb multiplied(const Matrix& matrix, Rgb c) {
  Rgb result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[static_cast<int>(i)] =
        std::max(0.0f, matrix[i][0] * c.r + matrix[i][1] * c.g + matrix[i][2] * c.b);
  }
  return result;
}

Rgb rec_709(Rgb c, ColorSpace space) {
  switch (space) {
    case ColorSpace::rec2020:
      return multiplied(kFromRec2020, c);
    case ColorSpace::dci_p3:
      return multiplied(kFromP3, c);
    case ColorSpace::aces2065_1:
      return multiplied(kFromAces, c);
    default:
      return c;
  }
}

/// Scales the color of a light to luminance 1. Black remains black.
Rgb normalized(Rgb c) {
  const float y = luminance(c);
  return y > 0 ? c / y : c;
}

Color from_list(const WavelengthList& list, ColorRole role) {
  const importing::WavelengthFunction at = [&](double wavelength) { return list.at(wavelength); };
  if (role == ColorRole::light) {
    return {.value = normalized(importing::color_of_light(at)), .approximated = true};
  }
  return {.value = importing::color_in_daylight(at), .approximated = true};
}

WavelengthList pairs_of(const Parameter& parameter) {
  if (parameter.numbers.size() < 4 || parameter.numbers.size() % 2 != 0) {
    throw InputError(parameter.where,
                     fmt::format("'{}' must be pairs of a wavelength and a value, at least two",
                                 parameter.name));
  }
  WavelengthList list;
  for (std::size_t i = 0; i < parameter.numbers.size(); i += 2) {
    const std::string problem = list.add(parameter.numbers[i], parameter.numbers[i + 1]);
    if (!problem.empty()) throw InputError(parameter.where, problem);
  }
  return list;
}

[[noreturn]] void fail_color(const Parameter& parameter, const char* expected) {
  throw InputError(parameter.where, fmt::format("'{}' must be {}", parameter.name, expected));
}

Color black_body_color(const Parameter& parameter) {
  const double kelvin = parameter.numbers.front();
  if (parameter.numbers.size() != 1 || !(kelvin >= 100 && kelvin <= 1e6)) {
    fail_color(parameter, "one temperature between 100 and 1000000 kelvin");
  }
  // Relative to the value at 555 nm, so that no temperature is beyond what a float can hold.
  const double unit = importing::black_body(kelvin, 555);
  const Rgb color = importing::color_of_light(
      [&](double wavelength) { return importing::black_body(kelvin, wavelength) / unit; });
  return {.value = normalized(color), .approximated = true};
}

}  // namespace

ColorSpace color_space(const std::string& name) {
  const std::vector<std::string> known{"srgb", "rec2020", "dci-p3", "aces2065-1"};
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    throw InputError(fmt::format("unknown color space '{}'{}; known: {}", one_line(name, 60),
                                 suggestion(name, known), quoted_list(known)));
  }
  return static_cast<ColorSpace>(found - known.begin());
}

Color ColorReader::read_spectrum(const Parameter& parameter, ColorRole role) const {
  if (parameter.texts.empty()) {
    if (parameter.numbers.size() == 1) {
      const auto value = static_cast<float>(parameter.numbers.front());
      return {.value = Rgb(role == ColorRole::light ? 1 : value), .is_gray = true};
    }
    return from_list(pairs_of(parameter), role);
  }
  const std::string& name = parameter.texts.front();
  if (const std::optional<Rgb> known = named_spectrum(name)) {
    const bool is_gray = known->r == known->g && known->g == known->b;
    return {.value = role == ColorRole::light ? normalized(*known) : *known, .is_gray = is_gray};
  }
  const std::filesystem::path path = file_in(folder_, name);
  if (const std::string problem = file_problem(path); !problem.empty()) {
    throw InputError(parameter.where,
                     fmt::format("'{}' is neither a spectrum's name{} nor a file: {}",
                                 one_line(name, 200), suggestion(name, spectrum_names()), problem));
  }
  return from_list(importing::read_spectrum_file(path, budget_), role);
}

Color ColorReader::read(const Parameter& parameter, ColorRole role, ColorSpace space) const {
  if (parameter.type == "spectrum") return read_spectrum(parameter, role);
  if (parameter.type == "blackbody") return black_body_color(parameter);
  if (parameter.type == "float" || parameter.type == "integer") {
    if (parameter.numbers.size() != 1) fail_color(parameter, "one number or a color");
    return {.value = Rgb(static_cast<float>(parameter.numbers.front())), .is_gray = true};
  }
  if (parameter.type != "rgb" || parameter.numbers.size() != 3) {
    fail_color(parameter, "a color: one 'rgb', 'spectrum' or 'blackbody'");
  }
  const auto channel = [&](std::size_t i) { return static_cast<float>(parameter.numbers[i]); };
  return {.value = rec_709({channel(0), channel(1), channel(2)}, space)};
}

}  // namespace pharos::pbrt

#include "spectra.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../../shared/color_matching.h"
#include "../../shared/spectrum_file.h"
#include "names.h"
#include "values.h"

namespace pharos::mitsuba {
namespace {

using importing::black_body, importing::color_in_daylight, importing::color_of_light,
    importing::WavelengthFunction, importing::WavelengthList;

Spectrum gray(float value) {
  return {.value = Rgb(value), .is_gray = true};
}

/// Returns the color of `#rrggbb`, each channel divided by 255; empty for other texts.
std::optional<Rgb> parse_hexadecimal(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  unsigned digits = 0;
  const auto [rest, error] = std::from_chars(text.data() + 1, text.data() + 7, digits, 16);
  if (error != std::errc{} || rest != text.data() + 7) return std::nullopt;
  const auto channel = [&](unsigned shift) {
    return static_cast<float>((digits >> shift) & 0xff) / 255;
  };
  return Rgb(channel(16), channel(8), channel(0));
}

/// Reads one number, three numbers, or `#rrggbb`.
Spectrum read_rgb(const Element& element) {
  const std::vector<std::string_view> all = words(element.text("value"));
  if (all.size() == 1 && all[0].starts_with('#')) {
    const std::optional<Rgb> color = parse_hexadecimal(all[0]);
    if (!color) element.fail_value("value", "a color such as #ff8000");
    return {.value = *color};
  }
  if (all.size() != 1 && all.size() != 3) {
    element.fail_value("value", "one or three numbers, or a color such as #ff8000");
  }
  const std::vector<float> numbers = read_floats(element, "value");
  if (numbers.size() == 1) return gray(numbers[0]);
  return {.value = {numbers[0], numbers[1], numbers[2]}};
}

/// The inverse of the sRGB transfer function (IEC 61966-2-1).
float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

void check_intent(const Element& element) {
  const std::string intent = lower_case(element.text("intent"));
  if (element.has("intent") && intent != "reflectance" && intent != "illuminant") {
    element.fail_value("intent", "'reflectance' or 'illuminant'");
  }
}

Spectrum approximated(const Element& element, Rgb color) {
  if (!is_finite(color)) element.fail("expected a spectrum with a color of finite numbers");
  return {.value = color, .approximated = true};
}

Spectrum read_list(const Element& element, const WavelengthList& list, bool of_emitter) {
  const WavelengthFunction values = [&](double wavelength) { return list.at(wavelength); };
  return approximated(element, of_emitter ? color_of_light(values) : color_in_daylight(values));
}

WavelengthList parse_pairs(const Element& element) {
  WavelengthList list;
  for (const std::string_view word : words(element.text("value"))) {
    const std::size_t colon = std::min(word.find(':'), word.size());
    const auto wavelength = parse_number(word.substr(0, colon));
    const auto value = colon < word.size() ? parse_number(word.substr(colon + 1)) : std::nullopt;
    if (!wavelength || !value) {
      element.fail("value",
                   fmt::format("expected wavelength:value, found '{}'", one_line(word, 40)));
    }
    const std::string problem = list.add(*wavelength, *value);
    if (!problem.empty()) element.fail("value", problem);
  }
  if (list.size() < 2) element.fail_value("value", "at least two pairs wavelength:value");
  return list;
}

Spectrum read_values(const Element& element, bool of_emitter) {
  const std::string& text = element.text("value");
  if (text.find(':') != std::string::npos) {
    return read_list(element, parse_pairs(element), of_emitter);
  }
  const std::vector<float> numbers = read_floats(element, "value");
  if (numbers.size() == 1) return gray(numbers[0]);
  if (numbers.size() == 3) return {.value = {numbers[0], numbers[1], numbers[2]}};
  element.fail_value("value", "one or three numbers, or pairs wavelength:value");
}

Spectrum read_spectrum_tag(const Element& element, bool of_emitter, const Folders& folders,
                           importing::ReadingBudget& budget) {
  element.expect({"name"}, {"value", "filename", "intent"});
  check_intent(element);
  if (element.has("value") == element.has("filename")) {
    element.fail("<spectrum> needs either 'value' or 'filename'");
  }
  if (element.has("value")) return read_values(element, of_emitter);
  const WavelengthList list =
      importing::read_spectrum_file(folders.file(element, "filename"), budget);
  return read_list(element, list, of_emitter);
}

Spectrum read_black_body(const Element& element) {
  element.expect({"name", "temperature"}, {"scale"});
  std::string text = element.text("temperature");
  text.erase(text.find_last_not_of(" Kk") + 1);
  const double temperature = parse_number(text).value_or(0);
  if (!(temperature > 0)) element.fail_value("temperature", "kelvins above 0");
  const double scale = element.has("scale") ? read_number(element, "scale") : 1;
  return approximated(element, color_of_light([&](double wavelength) {
                        return scale * black_body(temperature, wavelength);
                      }));
}

}  // namespace

Spectrum read_spectrum(const Element& element, bool of_emitter, const Folders& folders,
                       importing::ReadingBudget& budget) {
  if (element.tag() == "spectrum") return read_spectrum_tag(element, of_emitter, folders, budget);
  if (element.tag() == "blackbody") return read_black_body(element);
  element.expect({"name", "value"}, {"intent"});
  check_intent(element);
  Spectrum color = read_rgb(element);
  if (element.tag() == "srgb") {
    for (int c = 0; c < 3; ++c) color.value[c] = linear_from_srgb(color.value[c]);
    if (!is_finite(color.value)) element.fail_value("value", "a color of finite numbers");
  }
  return color;
}

}  // namespace pharos::mitsuba

#include "values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace pharos::mitsuba {
namespace {

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

/// Parses `text` as a number. Errors are reported for the attribute that contains it.
float float_from(const Element& element, std::string_view attribute, std::string_view text) {
  const std::optional<double> value = parse_number(text);
  const auto single = static_cast<float>(value.value_or(0));
  if (!value || !std::isfinite(single)) {
    element.fail(attribute,
                 fmt::format("expected a finite number, found '{}'", one_line(text, 40)));
  }
  return single;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool has_axes(const Element& element) {
  return std::any_of(kAxes.begin(), kAxes.end(), [&](auto axis) { return element.has(axis); });
}

/// Returns three numbers, or one number three times.
Vec3 expanded(const Element& element) {
  const std::vector<float> all = read_floats(element, "value");
  if (all.size() == 1) return {all[0], all[0], all[0]};
  if (all.size() != 3) element.fail_value("value", "one or three numbers");
  return {all[0], all[1], all[2]};
}

}  // namespace

bool read_boolean(const Element& element, std::string_view attribute) {
  std::string text = element.text(attribute);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (text != "true" && text != "false") element.fail_value(attribute, "'true' or 'false'");
  return text == "true";
}

std::int64_t read_integer(const Element& element, std::string_view attribute) {
  std::string_view text = trimmed(element.text(attribute));
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (rest != end || error != std::errc{}) element.fail_value(attribute, "a whole number");
  return value;
}

double read_number(const Element& element, std::string_view attribute) {
  const std::optional<double> value = parse_number(trimmed(element.text(attribute)));
  if (!value) element.fail_value(attribute, "a finite number");
  return *value;
}

float read_float(const Element& element, std::string_view attribute) {
  return float_from(element, attribute, trimmed(element.text(attribute)));
}

std::vector<float> read_floats(const Element& element, std::string_view attribute) {
  std::vector<float> all;
  for (const std::string_view word : words(element.text(attribute))) {
    all.push_back(float_from(element, attribute, word));
  }
  return all;
}

Vec3 read_triple(const Element& element, std::string_view attribute) {
  const std::vector<float> all = read_floats(element, attribute);
  if (all.size() != 3) element.fail_value(attribute, "three numbers");
  return {all[0], all[1], all[2]};
}

Vec3 read_coordinates(const Element& element) {
  for (const std::string_view axis : kAxes) {
    if (!element.has("value") && !element.has(axis)) {
      element.fail(
          fmt::format("<{}> needs the attribute '{}', or all in 'value'", element.tag(), axis));
    }
  }
  return read_coordinates(element, 0);
}

Vec3 read_coordinates(const Element& element, float otherwise) {
  if (element.has("value") == has_axes(element)) {
    element.fail(fmt::format("<{}> needs either 'value' or 'x', 'y' and 'z'", element.tag()));
  }
  if (element.has("value")) return expanded(element);
  Vec3 v{otherwise, otherwise, otherwise};
  for (int i = 0; i < 3; ++i) {
    const std::string_view axis = kAxes[static_cast<std::size_t>(i)];
    if (element.has(axis)) v[i] = read_float(element, axis);
  }
  return v;
}

}  // namespace pharos::mitsuba

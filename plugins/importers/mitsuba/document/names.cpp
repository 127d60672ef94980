#include "names.h"

#include <charconv>

#include <fmt/format.h>

#include <pharos/core/error.h>

namespace pharos::mitsuba {
namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
char to_lower(char c) {
  return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

Dialect dialect_of(std::string_view version) {
  const bool is_version =
      !version.empty() && version.find_first_not_of("0123456789.") == std::string_view::npos;
  int major = 0;
  const auto [rest, error] =
      std::from_chars(version.data(), version.data() + version.size(), major);
  const bool has_more = is_version && rest != version.data() + version.size() && *rest == '.';
  if (!has_more || error != std::errc{} || major > 3) {
    throw InputError(fmt::format("expected a version such as 0.6.0 or 3.0.0, found '{}'",
                                 one_line(version, 40)));
  }
  return major < 2 ? Dialect::mitsuba_0 : Dialect::mitsuba_2;
}

std::string snake_case(std::string_view name) {
  std::string result;
  bool in_capitals = false;  // in the capitals of a word that began inside the name
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool begins_word = i > 0 && is_lower(name[i - 1]) && is_upper(name[i]);
    in_capitals = begins_word || (in_capitals && is_upper(name[i]));
    if (begins_word) result += '_';
    result += in_capitals ? to_lower(name[i]) : name[i];
  }
  return result;
}

std::string lower_case(std::string_view text) {
  std::string result;
  for (const char c : text) result += to_lower(c);
  return result;
}

}  // namespace pharos::mitsuba

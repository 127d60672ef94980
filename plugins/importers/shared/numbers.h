#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace pharos::importing {

/// Splits a text into words at blanks and commas.
std::vector<std::string_view> words(std::string_view text);

/// Parses a finite number without blanks around it; empty if `text` is not a number. A number too
/// small for a double is 0.
std::optional<double> parse_number(std::string_view text);

}  // namespace pharos::importing

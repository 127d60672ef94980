#pragma once

#include <charconv>

namespace pharos {

/// As std::from_chars, but what is nearer to zero than every double becomes 0, and what is beyond
/// every double infinite.
std::from_chars_result read_decimal(const char* first, const char* last, double& value);

}  // namespace pharos

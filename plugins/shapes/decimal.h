#pragma once

#include <charconv>

namespace pharos {

/// Reads a number in the same way as std::from_chars. However, numbers nearer to zero than every
/// double become 0, and numbers beyond every double become infinite.
std::from_chars_result read_decimal(const char* first, const char* last, double& value);

}  // namespace pharos

#pragma once

#include <cstddef>
#include <string_view>

namespace pharos::mitsuba {

/// Returns the offset of the first byte of `text` that does not belong to a UTF-8 character (RFC
/// 3629). A zero byte counts as invalid. Returns std::string_view::npos if all bytes are valid.
std::size_t first_bad_byte(std::string_view text);

}  // namespace pharos::mitsuba

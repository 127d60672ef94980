#pragma once

#include <cstddef>
#include <string_view>

namespace pharos::mitsuba {

/// Offset of the first byte of `text` that belongs to no character of UTF-8 (RFC 3629), a zero
/// among them; std::string_view::npos when there is none.
std::size_t first_bad_byte(std::string_view text);

}  // namespace pharos::mitsuba

#pragma once

#include <cstdint>
#include <string_view>

namespace pharos {

/// Returns a checksum of bytes (XXH3, 64 bits). It finds damage, not forgery.
std::uint64_t checksum(std::string_view bytes);

}  // namespace pharos

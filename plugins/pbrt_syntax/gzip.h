#pragma once

#include <cstddef>
#include <string>

namespace pharos::pbrt {

/// Returns what a gzip file (RFC 1952) holds, or any other `bytes` as they are. pbrt reads packed
/// scenes and meshes. Throws InputError if the file is damaged or cut off, or if it holds more than
/// `most` bytes.
std::string unpacked(std::string bytes, std::size_t most);

}  // namespace pharos::pbrt

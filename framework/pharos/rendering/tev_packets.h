#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <pharos/core/image.h>

namespace pharos {

/// Packets of the protocol by which the image viewer tev is told from outside what to show
/// (https://github.com/Tom94/tev, include/tev/Ipc.h and src/Ipc.cpp as of 2025). They follow each
/// other on a TCP connection; nothing comes back. A packet is
///
///   uint32 length of the packet in bytes, itself included | uint8 type | contents
///
/// little-endian, with texts that end in a zero byte, and flags of one byte.

/// The port tev listens on unless told otherwise.
inline constexpr std::uint16_t kTevPort = 14158;

/// Makes an image of channels R, G and B in the viewer, instead of an older one of that name, and
/// brings it to the front. Type 4, then
/// flag focus | text name | int32 width, height, channel count | text per channel.
std::vector<char> tev_create_image(std::string_view name, int width, int height);

/// New values for `rows` rows from row `first` on; `image` begins with the channels R, G and B.
/// Type 6, then
/// flag focus | text name | int32 channel count | text per channel | int32 x, y, width, height |
/// int64 offset per channel | int64 stride per channel | float32 values,
/// where a channel's value of pixel i of the rectangle stands at offset + i x stride.
std::vector<char> tev_update_image(std::string_view name, const Image& image, int first, int rows);

}  // namespace pharos

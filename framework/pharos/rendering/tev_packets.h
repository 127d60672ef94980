#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <pharos/core/image.h>

namespace pharos {

/// Packets of the protocol that controls the image viewer tev from outside
/// (https://github.com/Tom94/tev, include/tev/Ipc.h and src/Ipc.cpp as of 2025). They follow each
/// other on a TCP connection, and the viewer does not answer. A packet is
///
///   uint32 length of the packet in bytes, including this number | uint8 type | contents
///
/// Numbers are little-endian, texts end with a zero byte, and flags are one byte.

/// The default port of tev.
inline constexpr std::uint16_t kTevPort = 14158;

/// Creates an image with channels R, G and B in the viewer, replacing an older one of the same
/// name, and brings it to the front. The packet has type 4 and the contents
/// flag focus | text name | int32 width, height, channel count | text per channel.
std::vector<char> tev_create_image(std::string_view name, int width, int height);

/// Sends new values for `rows` rows, beginning with row `first`. The first channels of `image` must
/// be R, G and B. The packet has type 6 and the contents
/// flag focus | text name | int32 channel count | text per channel | int32 x, y, width, height |
/// int64 offset per channel | int64 stride per channel | float32 values.
/// The value of pixel i of the rectangle is at index offset + i x stride of its channel.
std::vector<char> tev_update_image(std::string_view name, const Image& image, int first, int rows);

}  // namespace pharos

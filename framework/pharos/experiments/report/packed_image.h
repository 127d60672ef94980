#pragma once

#include <string>

#include <pharos/core/image.h>

namespace pharos {

/// An image as the page stores it: numbers of half precision, first the high bytes of all numbers,
/// then the low bytes (zlib compresses this order better than pairs), deflated with zlib's header,
/// in base64. Channels are consecutive planes. The value of a pixel is its half times `scale`.
struct PackedImage {
  int width = 0, height = 0, channels = 0;
  float scale = 1;
  std::string base64;
};

/// Packs channels R, G, B. Finite values beyond +-65504 become +-65504. Throws InputError if a
/// channel is missing.
PackedImage pack_radiance(const Image& image);

/// Packs the first channel. The scale is a power of two such that the largest value is within the
/// range of a half and, if possible, the small values are too.
PackedImage pack_map(const Image& map);

/// Encodes bytes as base64 of RFC 4648, padded.
std::string base64(const std::string& bytes);

}  // namespace pharos

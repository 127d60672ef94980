#pragma once

#include <string>

#include <pharos/core/image.h>

namespace pharos {

/// An image as the page carries it: numbers of half precision, first the high bytes of all, then
/// the low bytes (which zlib shrinks better than pairs), deflated with zlib's header, in base64.
/// Channels follow one another as planes. A pixel's value is its half times `scale`.
struct PackedImage {
  int width = 0, height = 0, channels = 0;
  float scale = 1;
  std::string base64;
};

/// Channels R, G, B. Finite values beyond +-65504 become that. Throws InputError when a channel is
/// missing.
PackedImage pack_radiance(const Image& image);

/// The first channel, with a power of two as scale such that neither the largest value nor, if it
/// can be helped, the small ones leave the range of a half.
PackedImage pack_map(const Image& map);

/// As of RFC 4648, padded.
std::string base64(const std::string& bytes);

}  // namespace pharos

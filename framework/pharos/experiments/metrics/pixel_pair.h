#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <pharos/core/image.h>

namespace pharos {

/// An image and its reference, pixel by pixel, rows from the top. Pixels with a value that is not
/// finite in either are invalid: black in both, so that no filter spreads them, and left out of
/// every mean.
struct PixelPair {
  int width = 0, height = 0;
  std::vector<Rgb> image, reference;
  std::vector<std::uint8_t> valid;  ///< 0 or 1
  std::size_t invalid_pixels = 0;

  std::size_t size() const { return valid.size(); }
};

/// The channels R, G and B of `image`, in this order and no others. Throws InputError, naming it,
/// when it has none.
Image rgb_only(const Image& image, std::string_view name = "the image");

/// Channels R, G and B of both. Throws InputError, naming both, when sizes differ, when one has no
/// such channels, and when no pixel is finite in both.
PixelPair pair_pixels(const Image& image, const Image& reference,
                      std::string_view image_name = "the image",
                      std::string_view reference_name = "the reference");

/// The mean of `errors`, one a pixel, over the valid pixels: summed by rows, so that the bits are
/// the same for any number of threads.
double mean_error(const std::vector<double>& errors, const PixelPair& pair);

}  // namespace pharos

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <pharos/core/image.h>

namespace pharos {

/// An image and its reference, pixel by pixel, rows from the top. Pixels with a value that is not
/// finite in either image are invalid. They are black in both images, so that no filter spreads
/// them, and are left out of every mean.
struct PixelPair {
  int width = 0, height = 0;
  std::vector<Rgb> image, reference;
  std::vector<std::uint8_t> valid;  ///< 0 or 1
  std::size_t invalid_pixels = 0;

  std::size_t size() const { return valid.size(); }
};

/// Returns the channels R, G and B of `image`, in this order and no others. Throws InputError, with
/// the name of the image, if a channel is missing.
Image rgb_only(const Image& image, std::string_view name = "the image");

/// Pairs the channels R, G and B of both images. Throws InputError, with both names, if the sizes
/// differ, if an image lacks these channels, or if no pixel is finite in both.
PixelPair pair_pixels(const Image& image, const Image& reference,
                      std::string_view image_name = "the image",
                      std::string_view reference_name = "the reference");

/// Returns the mean of `values`, one per pixel, over the valid pixels whose value is not NaN. The
/// sum is accumulated by rows, so it has the same bits for any number of threads.
double mean_over_pixels(const std::vector<double>& values, const PixelPair& pair);

}  // namespace pharos

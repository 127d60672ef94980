#pragma once

#include <cmath>
#include <cstdint>

#include <pharos/core/image.h>
#include <pharos/core/random.h>

namespace pharos::test {

/// Returns an image with one color in every pixel.
inline Image constant(int width, int height, Rgb value) {
  Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, value);
  }
  return image;
}

/// Returns colored stripes and a gradient over `stops` stops of brightness.
inline Image pattern(int width, int height, double stops = 2) {
  Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = static_cast<double>(x) / width, v = static_cast<double>(y) / height;
      const double light = 0.8 * std::exp2(stops * (v - 1));
      image.set_rgb(x, y,
                    {static_cast<float>(light * (0.6 + 0.4 * std::sin(40 * u))),
                     static_cast<float>(light * (0.5 + 0.5 * std::sin(9 * v + 2 * u))),
                     static_cast<float>(light * (x / 5 % 2 == 0 ? 0.9 : 0.1))});
    }
  }
  return image;
}

/// Returns `image` times independent numbers of mean 1 with the spread `noise`. Equal seeds give
/// equal results.
inline Image noisy(const Image& image, double noise, std::uint64_t seed = 1) {
  Image result = image;
  RandomStream random(seed);
  for (float& v : result.values()) v *= static_cast<float>(1 + noise * (2 * random.next_1d() - 1));
  return result;
}

}  // namespace pharos::test

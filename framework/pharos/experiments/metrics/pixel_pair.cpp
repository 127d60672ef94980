#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/parallel.h>
#include <pharos/experiments/metrics/pixel_pair.h>

namespace pharos {
namespace {

/// Reads the colors of an image with channels in any order.
class ColorReader {
 public:
  ColorReader(const Image& image, std::string_view name) : image_(image) {
    constexpr std::array kNames{"R", "G", "B"};
    for (std::size_t c = 0; c < kNames.size(); ++c) {
      channels_[c] = image.channel_index(kNames[c]);
      if (channels_[c] >= 0) continue;
      throw InputError(fmt::format("{}: error: expected channels R, G and B, found {}", name,
                                   quoted_list(image.channels())));
    }
  }
  Rgb operator()(int x, int y) const {
    const float* p = image_.pixel(x, y);
    return {p[channels_[0]], p[channels_[1]], p[channels_[2]]};
  }

 private:
  const Image& image_;
  std::array<int, 3> channels_{};
};

void check_sizes(const Image& image, const Image& reference, std::string_view image_name,
                 std::string_view reference_name) {
  if (image.width() == reference.width() && image.height() == reference.height()) return;
  throw InputError(fmt::format("{}: error: expected the size of {}, {} x {} pixels, found {} x {}",
                               image_name, reference_name, reference.width(), reference.height(),
                               image.width(), image.height()));
}

}  // namespace

Image rgb_only(const Image& image, std::string_view name) {
  const ColorReader color(image, name);
  Image result(image.width(), image.height(), {"R", "G", "B"});
  parallel_for(static_cast<std::size_t>(image.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width(); ++x) result.set_rgb(x, y, color(x, y));
  });
  return result;
}

PixelPair pair_pixels(const Image& image, const Image& reference, std::string_view image_name,
                      std::string_view reference_name) {
  const ColorReader ours(image, image_name), theirs(reference, reference_name);
  check_sizes(image, reference, image_name, reference_name);
  PixelPair pair{.width = image.width(), .height = image.height()};
  const std::size_t size = static_cast<std::size_t>(pair.width) * pair.height;
  pair.image.resize(size);
  pair.reference.resize(size);
  pair.valid.resize(size);
  parallel_for(static_cast<std::size_t>(pair.height), [&](std::size_t row) {
    for (int x = 0; x < pair.width; ++x) {
      const std::size_t i = row * pair.width + x;
      const Rgb a = ours(x, static_cast<int>(row)), b = theirs(x, static_cast<int>(row));
      pair.valid[i] = is_finite(a) && is_finite(b);
      if (pair.valid[i]) pair.image[i] = a, pair.reference[i] = b;
    }
  });
  pair.invalid_pixels = std::count(pair.valid.begin(), pair.valid.end(), 0);
  if (pair.invalid_pixels == size) {
    throw InputError(fmt::format("{}: error: no pixel is finite both here and in {}", image_name,
                                 reference_name));
  }
  return pair;
}

double mean_over_pixels(const std::vector<double>& values, const PixelPair& pair) {
  std::vector<double> rows(pair.height);
  std::vector<std::size_t> counts(pair.height);
  parallel_for(rows.size(), [&](std::size_t row) {
    const std::size_t first = row * pair.width;
    for (std::size_t i = first; i < first + pair.width; ++i) {
      if (!pair.valid[i] || std::isnan(values[i])) continue;
      rows[row] += values[i];
      ++counts[row];
    }
  });
  const std::size_t count = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  return std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(count);
}

}  // namespace pharos

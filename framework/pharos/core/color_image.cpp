#include <cstring>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include <pharos/core/color_image.h>
#include <pharos/core/error.h>

namespace pharos {

ColorImage::ColorImage(int width, int height, int channels, Depth depth, std::vector<float> table)
    : width_(width),
      height_(height),
      channels_(channels),
      depth_(depth),
      data_(static_cast<std::size_t>(width) * height * channels * size_of(depth)),
      table_(std::move(table)) {}

ColorImage::ColorImage(int width, int height, const std::vector<Rgb>& pixels)
    : ColorImage(width, height, 3, Depth::single, {}) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  std::memcpy(data_.data(), pixels.data(), data_.size());
}

std::size_t ColorImage::size_of(Depth depth) {
  return depth == Depth::bits8 ? 1 : depth == Depth::single ? 4 : 2;
}

float ColorImage::from_half(std::uint16_t bits) {
  return Eigen::half_impl::half_to_float(Eigen::half_impl::raw_uint16_to_half(bits));
}

void check_colors(const ColorImage& image, const std::filesystem::path& file) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.pixel(x, y);
      if (is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0) continue;
      throw InputError(Location{.file = file.string()},
                       fmt::format("pixel ({}, {}) is negative or not finite", x, y));
    }
  }
}

}  // namespace pharos

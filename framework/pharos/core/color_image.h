#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/core/rgb.h>

namespace pharos {

/// The colors of an image file, kept at the depth of the file: textures are mostly of 8 bits, and
/// would take four times the memory as floats.
class ColorImage {
 public:
  /// The numbers of a channel: integers that a table maps to values, or numbers of floating point.
  enum class Depth { bits8, bits16, half, single };

  ColorImage() = default;
  /// Makes an image of one channel (gray) or three. `table` has a value for each integer; it is
  /// empty for the other depths.
  ColorImage(int width, int height, int channels, Depth depth, std::vector<float> table);
  /// Makes an image of floats from width x height pixels, row by row, top row first.
  ColorImage(int width, int height, const std::vector<Rgb>& pixels);

  int width() const { return width_; }
  int height() const { return height_; }
  Depth depth() const { return depth_; }
  /// The size of all pixels [bytes].
  std::size_t bytes() const { return data_.size(); }
  /// The numbers of all pixels, row by row, channels interleaved.
  std::byte* data() { return data_.data(); }

  Rgb pixel(int x, int y) const {
    const std::size_t first = (static_cast<std::size_t>(y) * width_ + x) * channels_;
    switch (depth_) {
      case Depth::bits8:
        return color<std::uint8_t>(first, [&](std::uint8_t n) { return table_[n]; });
      case Depth::bits16:
        return color<std::uint16_t>(first, [&](std::uint16_t n) { return table_[n]; });
      case Depth::half:
        return color<std::uint16_t>(first, from_half);
      case Depth::single:
        break;
    }
    return color<float>(first, [](float n) { return n; });
  }

  /// Returns the size of a number [bytes].
  static std::size_t size_of(Depth depth);

 private:
  /// Returns the color whose numbers begin at index `first`.
  template <class T, class Value>
  Rgb color(std::size_t first, Value&& value) const {
    const T* const numbers = reinterpret_cast<const T*>(data_.data()) + first;
    if (channels_ == 1) return Rgb(value(numbers[0]));
    return {value(numbers[0]), value(numbers[1]), value(numbers[2])};
  }
  static float from_half(std::uint16_t bits);

  int width_ = 0, height_ = 0, channels_ = 1;
  Depth depth_ = Depth::single;
  std::vector<std::byte> data_;
  std::vector<float> table_;
};

/// Reads the colors of an image file, see Image::color_channels() and read_image(). Throws
/// InputError as read_image() does.
ColorImage read_colors(const std::filesystem::path& path,
                       ColorSpace integer_formats = ColorSpace::srgb);

/// Throws InputError, located at `file`, for a value that is negative or not finite.
void check_colors(const ColorImage& image, const std::filesystem::path& file);

}  // namespace pharos

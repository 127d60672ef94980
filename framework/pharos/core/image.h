#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/rgb.h>

namespace pharos {

/// An image of float pixels with named, interleaved channels. Rows are stored from top to bottom.
class Image {
 public:
  Image() = default;
  /// Makes an image of zeros. Channel names follow OpenEXR, such as "R", "albedo.R" or "depth.Z".
  Image(int width, int height, std::vector<std::string> channels);

  int width() const { return width_; }
  int height() const { return height_; }
  int channel_count() const { return static_cast<int>(channels_.size()); }
  const std::vector<std::string>& channels() const { return channels_; }
  bool empty() const { return values_.empty(); }

  float* pixel(int x, int y) { return values_.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return values_.data() + offset(x, y); }
  /// Returns channels `first` to `first + 2` as a color.
  Rgb rgb(int x, int y, int first = 0) const {
    const float* p = pixel(x, y) + first;
    return {p[0], p[1], p[2]};
  }
  void set_rgb(int x, int y, Rgb value, int first = 0) {
    float* p = pixel(x, y) + first;
    p[0] = value.r, p[1] = value.g, p[2] = value.b;
  }
  std::vector<float>& values() { return values_; }
  const std::vector<float>& values() const { return values_; }

  /// Returns the index of the channel with this full name, or -1 if there is none.
  int channel_index(const std::string& name) const;
  /// Returns the indices of the red, green and blue channels. These are the channels R, G and B, or
  /// else Y three times. Without such names they are the first three channels, or the first channel
  /// three times if there are fewer than three.
  std::array<int, 3> color_channels() const;

  void archive(Archive& archive);

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * width_ + x) * channels_.size();
  }

  int width_ = 0, height_ = 0;
  std::vector<std::string> channels_;
  std::vector<float> values_;
};

/// Returns the number of pixels whose channels 0 to 2 are NaN or infinite.
std::size_t invalid_colors(const Image& image);

/// The text entries of an image file's header.
using Metadata = std::map<std::string, std::string>;

enum class ColorSpace { linear, srgb };

/// The most pixels of an image file that is read. A small file may claim to be huge.
inline constexpr std::size_t kMostPixels = std::size_t{1} << 28;

/// Loads the library for image files that are not OpenEXR files of Pharos, which otherwise happens
/// at the first use. Throws RunError if it cannot be loaded.
void prepare_image_files();

/// Reads all channels of an image file as float, in any format that OpenImageIO knows. Values of
/// 8-bit and 16-bit formats are decoded from sRGB unless `integer_formats` is `linear`; values of
/// float formats are linear. Channels keep their names, but only files of write_exr() keep their
/// order, so look them up by channel_index(). Throws InputError with the path if the file is
/// missing, unreadable or cut off, if the image is over 65,536 pixels wide or high or has more than
/// kMostPixels, and if it is deep or cropped (the OpenEXR data window is not the display window).
/// The size is checked before any pixel is read.
Image read_image(const std::filesystem::path& path, ColorSpace integer_formats = ColorSpace::srgb);

/// Reads the text entries of an image file's header. Throws InputError like read_image().
Metadata read_metadata(const std::filesystem::path& path);

/// Writes an OpenEXR file (32-bit float, ZIP) as a whole or not at all. Throws RunError.
void write_exr(const Image& image, const std::filesystem::path& path,
               const Metadata& metadata = {});

/// Writes an 8-bit sRGB PNG file as a whole or not at all. The file shows channels 0 to 2, or
/// channel 0 alone if there are fewer than three. Values are scaled by 2^exposure and then mapped
/// by a filmic curve (Narkowicz 2015) if `filmic` is set, else clipped. NaN becomes black. Throws
/// RunError.
void write_png(const Image& image, const std::filesystem::path& path, float exposure = 0,
               bool filmic = true);

/// The sRGB transfer function on [0,1] and its inverse (IEC 61966-2-1).
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);

}  // namespace pharos

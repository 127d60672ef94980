#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <pharos/core/rgb.h>

namespace pharos {

/// Rows of float pixels, top row first, with named channels interleaved.
class Image {
 public:
  Image() = default;
  /// All zero. Channel names are those of OpenEXR, such as "R", "albedo.R" or "depth.Z".
  Image(int width, int height, std::vector<std::string> channels);

  int width() const { return width_; }
  int height() const { return height_; }
  int channel_count() const { return static_cast<int>(channels_.size()); }
  const std::vector<std::string>& channels() const { return channels_; }
  bool empty() const { return values_.empty(); }

  float* pixel(int x, int y) { return values_.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return values_.data() + offset(x, y); }
  /// Channels `first` to `first + 2` as a color.
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

  /// Index of a channel by its full name; -1 when there is none.
  int channel_index(const std::string& name) const;
  /// The indices of red, green and blue: of the channels R, G, B or else Y three times; without
  /// such names the first three channels, or the first alone when there are fewer.
  std::array<int, 3> color_channels() const;

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * width_ + x) * channels_.size();
  }

  int width_ = 0, height_ = 0;
  std::vector<std::string> channels_;
  std::vector<float> values_;
};

/// Text entries of an image file's header.
using Metadata = std::map<std::string, std::string>;

enum class ColorSpace { linear, srgb };

/// Reads any format OpenImageIO knows, all channels, as float. Eight- and sixteen-bit formats are
/// taken as `srgb` unless told `linear`; float formats are linear. Throws InputError with the path
/// when the file is missing, unreadable, cut off, over 65,536 pixels wide or high or of more than
/// 2^30 values, deep, or cropped (OpenEXR's data window is not its display window). Channels keep
/// their names, not always their order: look them up by channel_index().
Image read_image(const std::filesystem::path& path, ColorSpace integer_formats = ColorSpace::srgb);

/// The text entries of an image file's header. Throws as read_image does.
Metadata read_metadata(const std::filesystem::path& path);

/// Writes OpenEXR (32-bit float, ZIP). The file appears whole or not at all; throws RunError.
void write_exr(const Image& image, const std::filesystem::path& path,
               const Metadata& metadata = {});

/// Writes an 8-bit sRGB PNG of channels 0-2 (of channel 0 when there are fewer) after scaling by
/// 2^exposure and a filmic curve (Narkowicz 2015) when `filmic`, else plain clipping. NaN shows as
/// black. The file appears whole or not at all; throws RunError.
void write_png(const Image& image, const std::filesystem::path& path, float exposure = 0,
               bool filmic = true);

/// The sRGB transfer function on [0,1] and its inverse (IEC 61966-2-1).
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);

}  // namespace pharos

#include <algorithm>
#include <cmath>
#include <dlfcn.h>
#include <optional>
#include <utility>

#include <pharos/core/error.h>
#include <pharos/core/exr_file.h>
#include <pharos/core/image_files.h>

namespace pharos {
namespace {

constexpr const char* kImageLibrary = "libpharos_images.so";

/// Loads the image library from the folder of this library. Throws RunError if that fails.
const ImageFiles* load_image_files() {
  Dl_info here;
  dladdr(reinterpret_cast<const void*>(&load_image_files), &here);
  const std::filesystem::path folder = std::filesystem::path(here.dli_fname).parent_path();
  void* library = dlopen((folder / kImageLibrary).c_str(), RTLD_NOW | RTLD_LOCAL);
  void* entry = library == nullptr ? nullptr : dlsym(library, "pharos_image_files");
  if (entry == nullptr) {
    throw RunError(std::string("images cannot be read or written: ") + one_line(dlerror()));
  }
  return reinterpret_cast<decltype(&pharos_image_files)>(entry)();
}

}  // namespace

const ImageFiles& image_files() {
  static const ImageFiles* const files = load_image_files();
  return *files;
}

Image::Image(int width, int height, std::vector<std::string> channels)
    : width_(width),
      height_(height),
      channels_(std::move(channels)),
      values_(static_cast<std::size_t>(width) * height * channels_.size()) {}

void Image::archive(Archive& archive) {
  archive(width_, height_, channels_);
  archive.block(values_);
  const bool is_sound = width_ >= 0 && height_ >= 0 &&
                        values_.size() == static_cast<std::size_t>(width_) *
                                              static_cast<std::size_t>(height_) * channels_.size();
  archive.expect(is_sound, "the image");
}

int Image::channel_index(const std::string& name) const {
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  return found == channels_.end() ? -1 : static_cast<int>(found - channels_.begin());
}

std::array<int, 3> Image::color_channels() const {
  const int r = channel_index("R"), g = channel_index("G"), b = channel_index("B");
  const int y = channel_index("Y");
  if (r >= 0 && g >= 0 && b >= 0) return {r, g, b};
  if (y >= 0) return {y, y, y};
  if (channel_count() < 3) return {0, 0, 0};
  return {0, 1, 2};
}

std::size_t invalid_colors(const Image& image) {
  std::size_t count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) count += is_finite(image.rgb(x, y)) ? 0 : 1;
  }
  return count;
}

void prepare_image_files() {
  image_files();
}

Image read_image(const std::filesystem::path& path, ColorSpace integer_formats) {
  std::optional<Image> own = read_own_exr(path);
  return own ? *std::move(own) : image_files().read(path, integer_formats);
}

ColorImage read_colors(const std::filesystem::path& path, ColorSpace integer_formats) {
  std::optional<ColorImage> own = read_own_exr_colors(path);
  return own ? *std::move(own) : image_files().read_colors(path, integer_formats);
}

Metadata read_metadata(const std::filesystem::path& path) {
  std::optional<Metadata> own = read_own_exr_metadata(path);
  return own ? *std::move(own) : image_files().read_metadata(path);
}

void write_png(const Image& image, const std::filesystem::path& path, float exposure, bool filmic) {
  image_files().write_png(image, path, exposure, filmic);
}

float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace pharos

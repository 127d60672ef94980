#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include <OpenImageIO/imageio.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/export.h>
#include <pharos/core/exr_header.h>
#include <pharos/core/image_files.h>

namespace pharos {
namespace {

/// Makes the image libraries work on the caller's thread. Their own thread pools would compete with
/// the renderer's.
void keep_to_one_thread() {
  static const bool done = OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);
  static_cast<void>(done);
}

[[noreturn]] void fail_reading(const std::filesystem::path& path, const std::string& why) {
  throw InputError("cannot read the image '" + path.string() + "': " + one_line(why));
}

/// As above: `what` is wrong, and `words` is what the image library says of it, if anything.
[[noreturn]] void fail_reading(const std::filesystem::path& path, const std::string& what,
                               const std::string& words) {
  fail_reading(path, words.empty() ? what : what + " (" + words + ")");
}

/// Returns the message of OpenImageIO, or `otherwise` if the message is empty.
std::string reason(const std::string& message, const std::string& otherwise) {
  return message.empty() ? otherwise : message;
}

/// Discards what libraries print on standard error as long as the object lives. libpng prints its
/// messages there although it also returns them. Only one object can exist at a time, because the
/// stream belongs to the whole process.
class SilentLibraries {
 public:
  SilentLibraries() : nowhere_(std::fopen("/dev/null", "w")) {
    if (nowhere_ != nullptr) stderr = nowhere_;
  }
  ~SilentLibraries() {
    stderr = kept_;
    if (nowhere_ != nullptr) std::fclose(nowhere_);
  }
  SilentLibraries(const SilentLibraries&) = delete;
  SilentLibraries& operator=(const SilentLibraries&) = delete;

 private:
  static inline std::mutex mutex_;
  std::lock_guard<std::mutex> lock_{mutex_};
  std::FILE* kept_ = stderr;
  std::FILE* nowhere_;
};

/// Runs `read` and turns exceptions of the image libraries into InputError.
template <class Read>
auto guarded_read(const std::filesystem::path& path, Read&& read) {
  const SilentLibraries silent;
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail_reading(path, "it does not fit into memory");
  } catch (const std::exception& e) {
    fail_reading(path, e.what());
  }
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path) {
  keep_to_one_thread();
  const std::string problem = file_problem(path);
  if (!problem.empty()) fail_reading(path, problem);
  if (!exr_header_fits(path)) {
    fail_reading(path, "it is damaged: an attribute of its header is longer than the file");
  }
  // Keep colors under transparent pixels as they were stored.
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  auto input = OIIO::ImageInput::open(path.string(), &wishes);
  if (!input) fail_reading(path, "it is damaged or of an unknown format", OIIO::geterror());
  return input;
}

void check_extent(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) {
    fail_reading(path, "it has no pixels (" + size + ")");
  }
  if (spec.width > kLargestEdge || spec.height > kLargestEdge) {
    fail_reading(path, "it has " + size + " pixels, more than " + std::to_string(kLargestEdge) +
                           " along an edge");
  }
  if (static_cast<std::size_t>(spec.width) * spec.height > kMostPixels) {
    fail_reading(path, "it has " + size + " pixels, more than the " + std::to_string(kMostPixels) +
                           " that Pharos reads");
  }
  if (spec.nchannels > kMostChannels) {
    fail_reading(path, "it has " + std::to_string(spec.nchannels) + " channels, more than " +
                           std::to_string(kMostChannels));
  }
  if (static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels > kMostValues) {
    fail_reading(path, "it has " + size + " pixels of " + std::to_string(spec.nchannels) +
                           " channels, more than the " + std::to_string(kMostValues) +
                           " values that Pharos reads");
  }
  if (spec.deep || spec.depth > 1) fail_reading(path, "deep and volume images are not supported");
  const bool whole = spec.x == spec.full_x && spec.y == spec.full_y &&
                     spec.width == spec.full_width && spec.height == spec.full_height;
  if (!whole) {
    fail_reading(path, "its data window (" + size + ") is not its display window (" +
                           std::to_string(spec.full_width) + " x " +
                           std::to_string(spec.full_height) + "); save it uncropped");
  }
}

/// Takes what the reader returned. Some readers fill in missing pixels, report success and only
/// leave a message.
void check_complete(const std::filesystem::path& path, const OIIO::ImageInput& input,
                    bool success) {
  if (!success || input.has_error()) {
    fail_reading(path, "it is cut off or damaged", input.geterror());
  }
}

void decode_srgb(Image& image, int alpha_channel) {
  const int channels = image.channel_count();
  std::vector<float>& values = image.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_alpha = static_cast<int>(i % channels) == alpha_channel;
    if (!is_alpha) values[i] = linear_from_srgb(values[i]);
  }
}

/// Writes `values` as an image file in the format `format`. Throws RunError with the path.
void write_image(const std::filesystem::path& path, const std::string& format,
                 const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* values) {
  keep_to_one_thread();
  const auto fail = [&](const std::string& why) {
    throw RunError("cannot write the image '" + path.string() + "': " + one_line(why));
  };
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail("it has no pixels");
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    try {
      const auto output = OIIO::ImageOutput::create(format);
      if (!output) fail(reason(OIIO::geterror(), "no writer for " + format));
      const bool written = output->open(temporary.string(), spec) &&
                           output->write_image(type, values) && output->close();
      if (!written) fail(reason(output->geterror(), "unknown reason"));
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {
      fail(e.what());
    }
  });
}

/// A fit of the ACES filmic curve (Narkowicz 2015, "ACES Filmic Tone Mapping Curve"). Large
/// arguments give values slightly above 1.
float filmic_curve(float x) {
  constexpr float saturated = 1e4f;  // the curve exceeds 1 there; avoids NaN for infinity
  x = std::min(x, saturated);
  return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

std::uint8_t display_byte(float linear, float scale, bool filmic) {
  const float positive = std::max(0.0f, linear * scale);  // NaN becomes 0
  const float shown = std::min(1.0f, filmic ? filmic_curve(positive) : positive);
  return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(shown)));
}

Image read_image_file(const std::filesystem::path& path, ColorSpace integer_formats) {
  return guarded_read(path, [&] {
    const auto input = open_image(path);
    const OIIO::ImageSpec& spec = input->spec();
    check_extent(path, spec);
    Image image(spec.width, spec.height, spec.channelnames);
    const bool complete =
        input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.values().data());
    check_complete(path, *input, complete);
    const bool encoded = !spec.format.is_floating_point() && integer_formats == ColorSpace::srgb;
    if (encoded) decode_srgb(image, spec.alpha_channel);
    return image;
  });
}

ColorImage::Depth depth_of(OIIO::TypeDesc format) {
  if (format == OIIO::TypeDesc::UINT8) return ColorImage::Depth::bits8;
  if (format == OIIO::TypeDesc::UINT16) return ColorImage::Depth::bits16;
  if (format == OIIO::TypeDesc::HALF) return ColorImage::Depth::half;
  return ColorImage::Depth::single;
}

OIIO::TypeDesc format_of(ColorImage::Depth depth) {
  switch (depth) {
    case ColorImage::Depth::bits8:
      return OIIO::TypeDesc::UINT8;
    case ColorImage::Depth::bits16:
      return OIIO::TypeDesc::UINT16;
    case ColorImage::Depth::half:
      return OIIO::TypeDesc::HALF;
    case ColorImage::Depth::single:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

/// Returns the values of all integers of a depth; empty for floating point.
std::vector<float> table_of(ColorImage::Depth depth, ColorSpace space) {
  if (depth == ColorImage::Depth::half || depth == ColorImage::Depth::single) return {};
  const int count = depth == ColorImage::Depth::bits8 ? 256 : 65536;
  std::vector<float> table;
  for (int i = 0; i < count; ++i) {
    const float value = static_cast<float>(i) * (1.0f / static_cast<float>(count - 1));
    table.push_back(space == ColorSpace::srgb ? linear_from_srgb(value) : value);
  }
  return table;
}

/// Copies numbers of `size` bytes: for each of `count` pixels, those at `channels`.
void pick_channels(const std::byte* from, std::size_t count, int from_channels,
                   const std::vector<int>& channels, std::size_t size, std::byte* to) {
  for (std::size_t i = 0; i < count; ++i) {
    for (const int channel : channels) {
      std::memcpy(to, from + (i * from_channels + channel) * size, size);
      to += size;
    }
  }
}

ColorImage read_color_file(const std::filesystem::path& path, ColorSpace integer_formats) {
  return guarded_read(path, [&] {
    const auto input = open_image(path);
    const OIIO::ImageSpec& spec = input->spec();
    check_extent(path, spec);
    const auto [red, green, blue] = Image(1, 1, spec.channelnames).color_channels();
    const bool is_gray = red == green && green == blue;
    const ColorImage::Depth depth = depth_of(spec.format);
    ColorImage image(spec.width, spec.height, is_gray ? 1 : 3, depth,
                     table_of(depth, integer_formats));
    const int first = std::min({red, green, blue}), end = std::max({red, green, blue}) + 1;
    const bool in_order = is_gray || (green == red + 1 && blue == red + 2);
    const std::size_t size = ColorImage::size_of(depth);
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
    std::vector<std::byte> others(in_order ? 0 : pixels * (end - first) * size);
    std::byte* to = in_order ? image.data() : others.data();
    const bool complete = input->read_image(0, 0, first, end, format_of(depth), to);
    check_complete(path, *input, complete);
    if (!in_order) {
      pick_channels(others.data(), pixels, end - first, {red - first, green - first, blue - first},
                    size, image.data());
    }
    return image;
  });
}

Metadata read_file_metadata(const std::filesystem::path& path) {
  return guarded_read(path, [&] {
    Metadata metadata;
    const auto input = open_image(path);
    for (const auto& entry : input->spec().extra_attribs) {
      if (entry.type() == OIIO::TypeDesc::STRING) {
        metadata[entry.name().string()] = entry.get_string();
      }
    }
    return metadata;
  });
}

void write_png_file(const Image& image, const std::filesystem::path& path, float exposure,
                    bool filmic) {
  const float scale = std::exp2(exposure);
  const int shown = image.channel_count() < 3 ? 1 : 3;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(static_cast<std::size_t>(image.width()) * image.height() * shown);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float* p = image.pixel(x, y);
      for (int c = 0; c < shown; ++c) bytes.push_back(display_byte(p[c], scale, filmic));
    }
  }
  OIIO::ImageSpec spec(image.width(), image.height(), shown, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_image(path, "png", spec, OIIO::TypeDesc::UINT8, bytes.data());
}

const ImageFiles kImageFiles{read_image_file, read_color_file, read_file_metadata, write_png_file};

}  // namespace
}  // namespace pharos

extern "C" PHAROS_EXPORT const pharos::ImageFiles* pharos_image_files() {
  return &pharos::kImageFiles;
}

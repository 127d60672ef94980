#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>
#include <zlib.h>

#include <pharos/core/error.h>
#include <pharos/experiments/report/half.h>
#include <pharos/experiments/report/packed_image.h>

namespace pharos {
namespace {

/// Clamps finite values to the range of a half. Infinities are kept, because they are errors that
/// the page should show.
std::uint16_t clamped_half(float value) {
  return half_from_float(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf)
                                              : value);
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw RunError("an image of the report cannot be compressed");
  packed.resize(size);
  return packed;
}

PackedImage pack(const Image& image, const std::vector<int>& channels, float scale) {
  PackedImage packed{image.width(), image.height(), static_cast<int>(channels.size()), scale, {}};
  const std::size_t pixels = static_cast<std::size_t>(image.width()) * image.height();
  const std::size_t count = pixels * channels.size();
  std::string bytes(2 * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t source = i % pixels * image.channel_count() + channels[i / pixels];
    const std::uint16_t half = clamped_half(image.values()[source] / scale);
    bytes[i] = static_cast<char>(half >> 8);
    bytes[count + i] = static_cast<char>(half & 255);
  }
  packed.base64 = base64(deflated(bytes));
  return packed;
}

}  // namespace

PackedImage pack_radiance(const Image& image) {
  std::vector<int> channels;
  for (const char* name : {"R", "G", "B"}) {
    channels.push_back(image.channel_index(name));
    if (channels.back() < 0) {
      throw InputError(std::string("an image of the report has no channel '") + name + "'");
    }
  }
  return pack(image, channels, 1);
}

PackedImage pack_map(const Image& map) {
  constexpr int kTopExponent =
      15;  // the largest value is scaled to [2^14, 2^15), so rounding cannot overflow
  constexpr int kLeastExponent =
      -126;  // smallest exponent of normal floats; the scale must be normal
  float largest = 0;
  for (std::size_t i = 0; i < map.values().size(); i += map.channel_count()) {
    const float magnitude = std::abs(map.values()[i]);
    if (std::isfinite(magnitude)) largest = std::max(largest, magnitude);
  }
  int exponent = kTopExponent;
  if (largest > 0) std::frexp(largest, &exponent);
  const int scale = std::max(exponent - kTopExponent, kLeastExponent);
  return pack(map, {0}, std::ldexp(1.0f, scale));
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t given = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < given ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= given ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace pharos

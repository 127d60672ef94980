// Tests that the page unpacks the original image, up to half precision.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>
#include <zlib.h>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/vec.h>
#include <pharos/experiments/report/half.h>
#include <pharos/experiments/report/packed_image.h>

namespace pharos {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    REQUIRE(digits.find(letter) != std::string::npos);
    bits = bits << 6 | static_cast<unsigned>(digits.find(letter));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

/// Returns the halfs of a packed image, plane after plane, as the page's data.js reads them.
std::vector<std::uint16_t> unpacked(const PackedImage& image) {
  const std::string packed = from_base64(image.base64);
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height * image.channels;
  std::vector<unsigned char> bytes(2 * count);
  uLongf size = bytes.size();
  REQUIRE(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     packed.size()) == Z_OK);
  REQUIRE(size == bytes.size());
  std::vector<std::uint16_t> halfs(count);
  for (std::size_t i = 0; i < count; ++i) {
    halfs[i] = static_cast<std::uint16_t>(bytes[i] << 8 | bytes[count + i]);
  }
  return halfs;
}

TEST_CASE("base64 is that of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("radiance comes back as halfs, whatever the order of channels") {
  Image image(7, 5, {"depth.Z", "B", "G", "R"});
  std::mt19937 numbers(3);
  std::lognormal_distribution<float> values(0, 4);
  for (float& value : image.values()) value = values(numbers);
  image.pixel(2, 1)[3] = kNaN;
  image.pixel(3, 1)[3] = kInfinity;
  image.pixel(4, 1)[3] = 1e9f;
  image.pixel(5, 1)[3] = -1e9f;
  const PackedImage packed = pack_radiance(image);
  CHECK(packed.width == 7);
  CHECK(packed.height == 5);
  CHECK(packed.channels == 3);
  CHECK(packed.scale == 1);
  const std::vector<std::uint16_t> halfs = unpacked(packed);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        const float value = image.pixel(x, y)[3 - channel];
        const float bounded = std::isfinite(value) ? std::clamp(value, -65504.0f, 65504.0f) : value;
        CHECK(halfs[channel * 35 + y * 7 + x] == half_from_float(bounded));
      }
    }
  }
  CHECK(std::isnan(float_from_half(halfs[7 + 2])));
  CHECK(float_from_half(halfs[7 + 3]) == kInfinity);
  CHECK(float_from_half(halfs[7 + 4]) == 65504);
  CHECK(float_from_half(halfs[7 + 5]) == -65504);
}

TEST_CASE("maps keep their precision however small or large they are") {
  for (const float size : {1e-20f, 1e-6f, 1.0f, 1e9f, 3e38f}) {
    CAPTURE(size);
    Image map(3, 2, {"Y"});
    map.values() = {size, size / 3, size * 1e-6f, 0, kNaN, kInfinity};
    const PackedImage packed = pack_map(map);
    const std::vector<std::uint16_t> halfs = unpacked(packed);
    for (int i = 0; i < 3; ++i) {
      const double value = map.values()[i],
                   shown = double{float_from_half(halfs[i])} * packed.scale;
      CHECK(std::abs(shown - value) <= value * 0x1p-11);
    }
    CHECK(halfs[3] == 0);
    CHECK(std::isnan(float_from_half(halfs[4])));
    CHECK(float_from_half(halfs[5]) == kInfinity);
  }
}

TEST_CASE("maps without a positive value are zero") {
  const PackedImage packed = pack_map(Image(2, 2, {"Y"}));
  CHECK(unpacked(packed) == std::vector<std::uint16_t>(4, 0));
}

TEST_CASE("an image without colors is refused by the name of what is missing") {
  CHECK_THROWS_WITH_AS(pack_radiance(Image(2, 2, {"R", "G"})), doctest::Contains("no channel 'B'"),
                       InputError);
}

}  // namespace
}  // namespace pharos

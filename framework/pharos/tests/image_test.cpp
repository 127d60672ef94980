#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/image.h>
#include <pharos/core/random.h>

#include "fixtures.h"

using namespace pharos;

namespace {

Image noise(int width, int height, std::vector<std::string> channels) {
  Image image(width, height, std::move(channels));
  RandomStream random(1);
  for (float& v : image.values()) v = random.next_1d();
  return image;
}

Image gray(float value) {
  Image image(2, 1, {"R", "G", "B"});
  for (float& v : image.values()) v = value;
  return image;
}

/// Returns an uncompressed gray 8-bit TIFF of 64 x 64 pixels. Its only strip comes last.
std::string tiff_bytes() {
  std::string bytes = "II*";
  bytes += '\0';
  const auto put = [&](std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  };
  constexpr std::uint16_t kShort = 3, kLong = 4;
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t value;
  };
  constexpr std::array<Entry, 8> entries{{{256, kShort, 64},     // width
                                          {257, kShort, 64},     // height
                                          {258, kShort, 8},      // bits per sample
                                          {259, kShort, 1},      // no compression
                                          {262, kShort, 1},      // black is zero
                                          {273, kLong, 110},     // start of the strip
                                          {278, kShort, 64},     // rows in the strip
                                          {279, kLong, 4096}}};  // bytes in the strip
  put(8, 4);
  put(entries.size(), 2);
  for (const Entry& entry : entries) {
    put(entry.tag, 2);
    put(entry.type, 2);
    put(1, 4);
    put(entry.value, 4);
  }
  put(0, 4);
  return bytes + std::string(4096, 'x');
}

std::size_t files_in(const test::TemporaryFolder& folder) {
  const std::filesystem::directory_iterator files(folder.path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

TEST_CASE("OpenEXR keeps every bit, every channel by name, and the metadata") {
  const test::TemporaryFolder folder;
  const Image image = noise(37, 23, {"R", "G", "B", "variance.R", "albedo.G", "depth.Z"});
  const Metadata metadata{{"pharos:config", "a: 1\nb: [1, 2]\n"},
                          {"pharos:long", std::string(70'000, 'x')}};
  write_exr(image, folder / "a.exr", metadata);
  const Image back = read_image(folder / "a.exr");
  REQUIRE(back.width() == 37);
  REQUIRE(back.height() == 23);
  REQUIRE(back.channel_count() == 6);
  for (int c = 0; c < 3; ++c) CHECK(back.channels()[c] == image.channels()[c]);
  for (int c = 0; c < 6; ++c) {
    const int at = back.channel_index(image.channels()[c]);
    REQUIRE(at >= 0);
    for (int y = 0; y < 23; ++y) {
      for (int x = 0; x < 37; ++x) CHECK(back.pixel(x, y)[at] == image.pixel(x, y)[c]);
    }
  }
  const Metadata read = read_metadata(folder / "a.exr");
  for (const auto& [key, text] : metadata) CHECK(read.at(key) == text);
  CHECK(files_in(folder) == 1);
}

TEST_CASE("equal images make equal files: no time of writing stands in them") {
  const test::TemporaryFolder folder;
  write_exr(noise(8, 8, {"R", "G", "B"}), folder / "a.exr");
  const Metadata metadata = read_metadata(folder / "a.exr");
  CHECK((metadata.count("DateTime") == 0 || metadata.at("DateTime").empty()));
}

TEST_CASE("PNG shows sRGB; reading takes it back to linear unless told otherwise") {
  const test::TemporaryFolder folder;
  write_png(gray(0.5f), folder / "a.png", 0, false);
  const float stored = std::round(255 * srgb_from_linear(0.5f)) / 255;
  CHECK(stored == doctest::Approx(188 / 255.0));
  CHECK(read_image(folder / "a.png").rgb(0, 0).g == doctest::Approx(linear_from_srgb(stored)));
  CHECK(read_image(folder / "a.png", ColorSpace::linear).rgb(1, 0).b == doctest::Approx(stored));
}

TEST_CASE("PNG: exposure, the filmic curve and values out of range") {
  const test::TemporaryFolder folder;
  const auto shown = [&](float value, float exposure, bool filmic) {
    write_png(gray(value), folder / "a.png", exposure, filmic);
    return std::lround(255 * read_image(folder / "a.png", ColorSpace::linear).rgb(0, 0).r);
  };
  CHECK(shown(0.125f, 2, false) == shown(0.5f, 0, false));
  CHECK(shown(4, 0, false) == 255);
  CHECK(shown(-1, 0, false) == 0);
  CHECK(shown(NAN, 0, true) == 0);
  CHECK(shown(kInfinity, 0, true) == 255);
  // The fit at 1 is 2.54 / 3.16.
  CHECK(shown(1, 0, true) == std::lround(255 * srgb_from_linear(2.54f / 3.16f)));
  CHECK(shown(0, 0, true) == 0);
}

TEST_CASE("the sRGB functions are inverses, and continuous where their pieces meet") {
  for (int i = 0; i <= 255; ++i) {
    const float v = i / 255.0f;
    CHECK(srgb_from_linear(linear_from_srgb(v)) == doctest::Approx(v).epsilon(1e-5));
  }
  CHECK(linear_from_srgb(0.5f) == doctest::Approx(0.21404114));
  CHECK(srgb_from_linear(0.0031308f) ==
        doctest::Approx(srgb_from_linear(0.0031309f)).epsilon(1e-3));
}

TEST_CASE("images that cannot be read are input errors on one line") {
  const test::TemporaryFolder folder;
  write_exr(noise(64, 64, {"R", "G", "B"}), folder / "whole.exr");
  folder.write("text.exr", "no image");
  const auto error = [&](std::string_view name) {
    return test::input_error_in(folder, [&] { read_image(folder / name); });
  };
  CHECK(error("whale.exr") ==
        "cannot read the image 'whale.exr': no such file (did you mean 'whole.exr'?)");
  // The words of the image library alone do not say that the file is to blame.
  folder.write("bad.gif", std::string("GIF89a\x10\0\x10\0junk", 14));
  for (const std::string name : {"text.exr", "bad.gif"}) {
    CHECK(error(name).find("cannot read the image '" + name +
                           "': it is damaged or of an unknown format (") == 0);
  }
  CHECK(test::input_error_in(folder, [&] { read_metadata(folder / "none.exr"); }) ==
        "cannot read the image 'none.exr': no such file");
  CHECK(test::input_error([&] { read_image(folder.path()); }) ==
        "cannot read the image '" + folder.path().string() + "': expected a file, found a folder");
}

TEST_CASE("images that are cut off are input errors, also where the reader fills the gap") {
  const test::TemporaryFolder folder;
  write_exr(noise(64, 64, {"R", "G", "B"}), folder / "a.exr");
  folder.write("a.tif", tiff_bytes());
  folder.write("a.ppm", "P6 64 64 255\n" + std::string(3 * 64 * 64, 'x'));
  for (const std::string name : {"a.exr", "a.tif", "a.ppm"}) {
    CHECK(read_image(folder / name).width() == 64);
    const std::string whole = test::bytes_of(folder / name);
    for (const double share : {0.02, 0.3, 0.7, 0.99}) {
      const std::string cut = "cut-" + name;
      folder.write(cut, whole.substr(0, static_cast<std::size_t>(share * whole.size())));
      CAPTURE(cut);
      CAPTURE(share);
      const std::string error = test::input_error_in(folder, [&] { read_image(folder / cut); });
      CHECK(error.find("cannot read the image '" + cut + "': it is ") == 0);
      CHECK(error.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("attributes of an image that claim more bytes than the file has are input errors") {
  const test::TemporaryFolder folder;
  write_exr(noise(4, 4, {"R", "G", "B"}), folder / "a.exr", {{"note", "short"}});
  std::string bytes = test::bytes_of(folder / "a.exr");
  const std::string attribute("note\0string\0", 12);
  const std::size_t size = bytes.find(attribute) + attribute.size();
  REQUIRE(size < bytes.size());
  REQUIRE(bytes.substr(size, 4) == std::string("\5\0\0\0", 4));
  const auto error = [&](const std::string& file) {
    folder.write("long.exr", file);
    return test::input_error_in(folder, [&] { read_metadata(folder / "long.exr"); });
  };
  const std::string expected =
      "cannot read the image 'long.exr': it is damaged: an attribute of its header is longer than "
      "the file";
  for (const char highest : {'\x4e', '\xff'}) {
    bytes[size + 3] = highest;
    CHECK(error(bytes) == expected);
  }
  // A file of several parts has several headers, each with a zero at its end.
  const std::string one_part("\x76\x2f\x31\x01\2\0\0\0", 8), parts("\x76\x2f\x31\x01\2\x10\0\0", 8);
  const std::string first("a\0string\0\1\0\0\0x\0", 15), second("b\0string\0\0\0\0\x4e", 13);
  CHECK(error(parts + first + second) == expected);
  CHECK(error(one_part + first + second) != expected);
}

TEST_CASE("images that cannot be written leave nothing behind") {
  const test::TemporaryFolder folder;
  const Image image = gray(1);
  const std::string path = folder.path().string();
  CHECK_THROWS_WITH_AS(
      write_exr(image, folder / "none/a.exr"),
      ("cannot write '" + path + "/none/a.exr': there is no folder '" + path + "/none'").c_str(),
      RunError);
  std::filesystem::create_directory(folder / "b.exr");
  CHECK_THROWS_AS(write_exr(image, folder / "b.exr"), RunError);
  CHECK_THROWS_AS(write_exr(Image(), folder / "c.exr"), RunError);
  CHECK(files_in(folder) == 1);
}

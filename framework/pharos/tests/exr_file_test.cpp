// OpenEXR files of Pharos, read by OpenEXR alone and by OpenImageIO: the same values, entries and
// messages.

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include <doctest/doctest.h>

#include <pharos/core/exr_file.h>
#include <pharos/core/image_files.h>
#include <pharos/core/random.h>

#include "fixtures.h"
#include "small_files.h"

namespace pharos::test {
namespace {

using Path = std::filesystem::path;

/// Returns numbers of all kinds: negative, tiny, infinite, and NaN.
Image numbers(int width, int height, std::vector<std::string> channels) {
  Image image(width, height, std::move(channels));
  RandomStream random(1);
  for (float& v : image.values()) v = 10 * random.next_1d() - 5;
  image.values().front() = std::numeric_limits<float>::quiet_NaN();
  image.values().back() = -std::numeric_limits<float>::infinity();
  image.values()[image.values().size() / 2] = std::numeric_limits<float>::denorm_min();
  return image;
}

/// Whether two images have the same channels, perhaps in another order, with the same bits.
bool same_bits(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  if (a.channel_count() != b.channel_count()) return false;
  for (int c = 0; c < a.channel_count(); ++c) {
    const int other = b.channel_index(a.channels()[c]);
    if (other < 0) return false;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        if (std::memcmp(a.pixel(x, y) + c, b.pixel(x, y) + other, sizeof(float)) != 0) return false;
      }
    }
  }
  return true;
}

/// Returns `bytes` with the only occurrence of `old` replaced.
std::string replaced(std::string bytes, const std::string& old, const std::string& other) {
  const std::size_t at = bytes.find(old);
  REQUIRE(at != std::string::npos);
  REQUIRE(bytes.find(old, at + 1) == std::string::npos);
  return bytes.replace(at, old.size(), other);
}

std::string little_endian(std::int32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  return bytes;
}

/// An attribute of a header, such as the data window, with numbers as its value.
std::string attribute(const std::string& name, const std::string& type,
                      const std::vector<std::int32_t>& values) {
  std::string bytes = name + '\0' + type + '\0';
  bytes += little_endian(static_cast<std::int32_t>(4 * values.size()));
  for (const std::int32_t value : values) bytes += little_endian(value);
  return bytes;
}

std::string window(const std::string& name, const std::vector<std::int32_t>& values) {
  return attribute(name, "box2i", values);
}

/// An entry in the list of channels.
std::string channel(const std::string& name, std::int32_t type, std::int32_t sampling) {
  return name + '\0' + little_endian(type) + std::string(4, '\0') + little_endian(sampling) +
         little_endian(1);
}

/// Returns a file of 8 x 5 pixels with channels R, G and B.
std::string small_file(const TemporaryFolder& folder) {
  write_exr(numbers(8, 5, {"R", "G", "B"}), folder / "small.exr", {{"note", "text"}});
  return bytes_of(folder / "small.exr");
}

TEST_CASE("own OpenEXR files keep the order of channels, and OpenImageIO reads the same") {
  const TemporaryFolder folder;
  const Image image = numbers(37, 23,
                              {"variance.R", "B", "A", "R", "G", "depth.Z",
                               "a channel with a name of more than 31 letters"});
  const Metadata metadata{{"pharos:config", "a: 1\n"}, {"note", "text"}};
  write_exr(image, folder / "a.exr", metadata);
  const auto own = read_own_exr(folder / "a.exr");
  REQUIRE(own.has_value());
  CHECK(own->channels() == image.channels());
  CHECK(same_bits(*own, image));
  CHECK(read_own_exr_metadata(folder / "a.exr") == metadata);
  CHECK(same_bits(image_files().read(folder / "a.exr", ColorSpace::srgb), image));
  const Metadata read = image_files().read_metadata(folder / "a.exr");
  for (const auto& [key, text] : metadata) CHECK(read.at(key) == text);
}

TEST_CASE("colors of own OpenEXR files are those that OpenImageIO reads") {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"B", "G", "A", "R"}, {"Y"}, {"R", "G", "B"}}) {
    write_exr(numbers(9, 4, channels), folder / "a.exr");
    auto own = read_own_exr_colors(folder / "a.exr");
    REQUIRE(own.has_value());
    ColorImage other = image_files().read_colors(folder / "a.exr", ColorSpace::srgb);
    CHECK(own->depth() == ColorImage::Depth::single);
    REQUIRE(own->bytes() == other.bytes());
    CHECK(std::memcmp(own->data(), other.data(), own->bytes()) == 0);
  }
}

TEST_CASE("equal images and entries make equal OpenEXR files") {
  const TemporaryFolder folder;
  const std::string first = small_file(folder);
  CHECK(small_file(folder) == first);
}

TEST_CASE("files by other programs are read by OpenImageIO") {
  const TemporaryFolder folder;
  const Path other =
      folder.write("other.exr", replaced(small_file(folder), "pharos:channels", "others:channels"));
  CHECK_FALSE(read_own_exr(other).has_value());
  CHECK_FALSE(read_own_exr_colors(other).has_value());
  CHECK_FALSE(read_own_exr_metadata(other).has_value());
  CHECK(same_bits(read_image(other), read_image(folder / "small.exr")));
  CHECK(read_metadata(other).at("note") == "text");
}

TEST_CASE("own files that were changed are not read as own files") {
  const TemporaryFolder folder;
  const std::string bytes = small_file(folder);
  const std::string data = window("dataWindow", {0, 0, 7, 4});
  const std::string shown = window("displayWindow", {0, 0, 7, 4});
  const std::string list = little_endian(1) + "R" + little_endian(1) + "G" + little_endian(1);
  const std::string version("\x76\x2f\x31\x01\2\0\0\0", 8);
  const auto refused = [&](const std::string& old, const std::string& other) {
    const Path file = folder.write("changed.exr", replaced(bytes, old, other));
    return !read_own_exr(file) && !read_own_exr_colors(file) && !read_own_exr_metadata(file);
  };
  CHECK_FALSE(refused(version, version));
  CHECK(refused(version, std::string("\x76\x2f\x31\x01\2\2\0\0", 8)));    // tiles
  CHECK(refused(version, std::string("\x76\x2f\x31\x01\2\x10\0\0", 8)));  // parts
  CHECK(refused(version, std::string("\x76\x2f\x31\x01\2\x08\0\0", 8)));  // deep pixels
  CHECK(refused(shown, window("displayWindow", {0, 0, 8, 4})));           // cropped
  CHECK(refused(shown, window("displayWindow", {-1, 0, 7, 4})));          // cropped
  CHECK(refused(channel("G", 2, 1), channel("G", 1, 1)));                 // half
  CHECK(refused(channel("G", 2, 1), channel("G", 2, 2)));                 // every other pixel
  CHECK(refused(channel("G", 2, 1), channel("H", 2, 1)));                 // a channel not listed
  CHECK(refused(list, little_endian(1) + "R" + little_endian(1) + "R" + little_endian(1)));
  CHECK(refused(data, window("dataWindow", {0, 0, 7, 5})));
}

TEST_CASE("own files that claim to be too large get the same message as others") {
  const TemporaryFolder folder;
  const std::string bytes = small_file(folder);
  const auto error = [&](std::int32_t right, std::int32_t bottom) {
    std::string large = bytes;
    for (const char* name : {"dataWindow", "displayWindow"}) {
      large = replaced(large, window(name, {0, 0, 7, 4}), window(name, {0, 0, right, bottom}));
    }
    const Path file = folder.write("large.exr", large);
    CHECK_FALSE(read_own_exr(file).has_value());
    return input_error_in(folder, [&] { read_image(file); });
  };
  const std::string start = "cannot read the image 'large.exr': it ";
  CHECK(error(65536, 4) == start + "has 65537 x 5 pixels, more than 65536 along an edge");
  CHECK(error(20000, 19999).find(start + "is damaged") == 0);  // lacks the table of the lines
}

/// Whether byte `i` of a file of up to 16 lines is in the table of the lines, which follows the
/// header.
bool is_in_line_table(const std::string& bytes, std::size_t i) {
  const std::string last("screenWindowWidth\0float\0\4\0\0\0", 28);
  const std::size_t table =
      bytes.find(last) + last.size() + 4 + 1;  // a value, the end of the header
  return i >= table && i < table + 8;
}

/// Reads an image by `read`. Returns the message of the error; empty if there is none.
template <class Read>
std::string outcome(Read&& read, std::optional<Image>& image) {
  return input_error([&] { image = read(); });
}

TEST_CASE("own files with any byte changed, or cut off anywhere, are read as by OpenImageIO") {
  const TemporaryFolder folder;
  const std::string bytes = small_file(folder);
  const auto check_same = [&](const std::string& damaged, bool values) {
    const Path file = folder.write("damaged.exr", damaged);
    std::optional<Image> here, there;
    const std::string error = outcome([&] { return read_image(file); }, here);
    CHECK(error == outcome([&] { return image_files().read(file, ColorSpace::srgb); }, there));
    if (here && there && values) CHECK(same_bits(*here, *there));
  };
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    CAPTURE(i);
    // If the table of lines is wrong, OpenEXR may return values that are not in the file.
    const bool values = !is_in_line_table(bytes, i);
    for (const int flipped : {1, 0x80, 0xff}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ flipped);
      check_same(damaged, values);
    }
    check_same(bytes.substr(0, i), true);
  }
}

TEST_CASE("OpenEXR files that do not fit on the disk are run errors and leave nothing behind") {
  const TemporaryFolder folder;
  const Image image = numbers(200, 200, {"R", "G", "B"});
  std::string message = "no error";
  try {
    const SmallFiles small;
    write_exr(image, folder / "a.exr");
  } catch (const RunError& error) {
    message = error.what();
  }
  CHECK(message.find("cannot write the image '" + (folder / "a.exr").string() + "': ") == 0);
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace pharos::test

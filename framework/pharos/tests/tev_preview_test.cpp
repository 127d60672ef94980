// The bytes that are sent to the image viewer, and how often an image is made for it.

#include <string>

#include <doctest/doctest.h>

#include <pharos/rendering/preview_pace.h>
#include <pharos/rendering/tev_packets.h>

namespace pharos {
namespace {

using namespace std::string_literals;

std::string text(const std::vector<char>& bytes) {
  return {bytes.begin(), bytes.end()};
}

TEST_CASE("bytes of a packet that makes an image") {
  const std::string expected =
      "\x1e\0\0\0"    // 30 bytes
      "\x04"          // create image
      "\x01"          // grab focus
      "a.exr\0"       //
      "\x05\x01\0\0"  // 261 wide
      "\x02\0\0\0"    // 2 high
      "\x03\0\0\0"    // channels
      "R\0G\0B\0"s;
  CHECK(expected.size() == 30);
  CHECK(text(tev_create_image("a.exr", 261, 2)) == expected);
}

TEST_CASE("bytes of a packet that updates an image") {
  Image image(1, 3, {"R", "G", "B", "depth.Z"});
  for (int y = 0; y < 3; ++y) image.set_rgb(0, y, {1, -2, static_cast<float>(y)});
  const std::string expected =
      "\x6a\0\0\0"          // 106 bytes
      "\x06"                // update image, third version
      "\0"                  // leave the focus
      "i\0"                 //
      "\x03\0\0\0"          // channels
      "R\0G\0B\0"           //
      "\0\0\0\0"            // x
      "\x01\0\0\0"          // y
      "\x01\0\0\0"          // width
      "\x02\0\0\0"          // height
      "\0\0\0\0\0\0\0\0"    // offsets
      "\x01\0\0\0\0\0\0\0"  //
      "\x02\0\0\0\0\0\0\0"  //
      "\x03\0\0\0\0\0\0\0"  // strides
      "\x03\0\0\0\0\0\0\0"  //
      "\x03\0\0\0\0\0\0\0"  //
      "\0\0\x80\x3f"        // 1
      "\0\0\0\xc0"          // -2
      "\0\0\x80\x3f"        // 1
      "\0\0\x80\x3f"        // 1
      "\0\0\0\xc0"          // -2
      "\0\0\0\x40"s;        // 2
  CHECK(expected.size() == 0x6a);
  CHECK(text(tev_update_image("i", image, 1, 2)) == expected);
}

TEST_CASE("images are made at most five times a second") {
  PreviewPace pace;
  CHECK(pace.due(0));
  pace.made(10, 0);
  CHECK_FALSE(pace.due(10.19));
  CHECK(pace.due(10.21));
}

TEST_CASE("making images takes a few per cent of the time at most") {
  PreviewPace pace;
  const double cost = 0.05, step = 0.01;
  double spent = 0;
  int images = 0;
  for (int i = 0; i * step < 100; ++i) {
    if (!pace.due(i * step)) continue;
    pace.made(i * step, cost);
    spent += cost;
    ++images;
    if (images > 1) REQUIRE(spent <= 0.0301 * i * step);
  }
  CHECK(spent > 0.029 * 100);
}

}  // namespace
}  // namespace pharos

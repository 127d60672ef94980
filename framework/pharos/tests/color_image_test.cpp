// Colors of image files, kept at the depth of the file, are those that read_image() returns.

#include <doctest/doctest.h>

#include <pharos/core/color_image.h>

#include "fixtures.h"

namespace pharos::test {
namespace {

/// Checks every pixel of a file against read_image().
void check_same_colors(const std::filesystem::path& file, ColorImage::Depth depth,
                       std::size_t bytes) {
  for (const ColorSpace space : {ColorSpace::srgb, ColorSpace::linear}) {
    const Image image = read_image(file, space);
    const ColorImage colors = read_colors(file, space);
    const auto [red, green, blue] = image.color_channels();
    CHECK(colors.depth() == depth);
    CHECK(colors.bytes() == bytes);
    REQUIRE(colors.width() == image.width());
    REQUIRE(colors.height() == image.height());
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const float* p = image.pixel(x, y);
        CHECK(colors.pixel(x, y) == Rgb(p[red], p[green], p[blue]));
      }
    }
  }
}

TEST_CASE("colors of 8 and 16 bits, gray and colored, and of floating point") {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 16 * 16 * 6; ++i) bytes += static_cast<char>(i * 7 + i / 256);
  check_same_colors(folder.write("a.ppm", "P6 16 16 255\n" + bytes.substr(0, 768)),
                    ColorImage::Depth::bits8, 768);
  check_same_colors(folder.write("a.pgm", "P5 16 16 255\n" + bytes.substr(0, 256)),
                    ColorImage::Depth::bits8, 256);
  check_same_colors(folder.write("b.ppm", "P6 16 16 65535\n" + bytes), ColorImage::Depth::bits16,
                    1536);
  Image image(5, 3, {"A", "B", "G", "R"});
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    image.values()[i] = 0.1f * static_cast<float>(i);
  }
  write_exr(image, folder / "a.exr");
  check_same_colors(folder / "a.exr", ColorImage::Depth::single, 5 * 3 * 3 * 4);
}

TEST_CASE("an image made from colors has these colors") {
  const std::vector<Rgb> pixels{{1, 2, 3}, {4, 5, 6}};
  const ColorImage image(2, 1, pixels);
  CHECK(image.pixel(0, 0) == pixels[0]);
  CHECK(image.pixel(1, 0) == pixels[1]);
}

TEST_CASE("colors that are negative or not finite are refused") {
  for (const float wrong : {-1.0f, kInfinity, std::nanf("")}) {
    const ColorImage image(2, 1, {Rgb(1), Rgb(0, wrong, 0)});
    CHECK(input_error([&] { check_colors(image, "a.exr"); }) ==
          "a.exr: error: pixel (1, 0) is negative or not finite");
  }
}

}  // namespace
}  // namespace pharos::test

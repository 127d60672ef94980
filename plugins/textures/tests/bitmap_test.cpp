#include "../bitmap.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

/// An image file that exists as long as this object.
class ImageFile {
 public:
  ImageFile(const std::string& name, const Image& image) : path_(folder_ / name) {
    if (path_.extension() == ".png") {
      write_png(image, path_, 0, false);
    } else {
      write_exr(image, path_);
    }
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  test::TemporaryFolder folder_;
  std::filesystem::path path_;
};

/// Two by two texels: 1 2 in the upper row, 3 4 in the lower.
Image four_texels() {
  Image image(2, 2, {"R", "G", "B"});
  image.set_rgb(0, 0, {1, 0, 0});
  image.set_rgb(1, 0, {2, 0, 0});
  image.set_rgb(0, 1, {3, 0, 0});
  image.set_rgb(1, 1, {4, 0, 8});
  return image;
}

float red(const Texture& texture, float u, float v) {
  SurfacePoint point;
  point.uv = {u, v};
  return texture.evaluate(point).r;
}

}  // namespace

TEST_CASE("bitmap: the lower left corner is (0, 0)") {
  const ImageFile file("corner.exr", four_texels());
  const Bitmap texture({.file = file.path(), .filter = BitmapFilter::nearest});
  CHECK(red(texture, 0.25f, 0.25f) == 3);
  CHECK(red(texture, 0.75f, 0.25f) == 4);
  CHECK(red(texture, 0.25f, 0.75f) == 1);
  CHECK(red(texture, 0.75f, 0.75f) == 2);
  CHECK(texture.maximum() == Rgb(4, 0, 8));
  CHECK(texture.average() == Rgb(2.5f, 0, 2));
}

TEST_CASE("bitmap: bilinear filter") {
  const ImageFile file("bilinear.exr", four_texels());
  const Bitmap texture({.file = file.path(), .wrap = BitmapWrap::clamp});
  CHECK(red(texture, 0.25f, 0.25f) == doctest::Approx(3));
  CHECK(red(texture, 0.5f, 0.5f) == doctest::Approx(2.5));
  CHECK(red(texture, 0.375f, 0.75f) == doctest::Approx(1.25));
  CHECK(red(texture, 0.25f, 0.375f) == doctest::Approx(2.5));
}

TEST_CASE("bitmap: outside the unit square") {
  const ImageFile file("wrap.exr", four_texels());
  const Bitmap repeat({.file = file.path()});
  CHECK(red(repeat, 0, 0.25f) == doctest::Approx(3.5));  // between the last column and the first
  CHECK(red(repeat, 1, 0.25f) == doctest::Approx(3.5));
  CHECK(red(repeat, 7.25f, -2.75f) == doctest::Approx(3));
  const Bitmap clamp({.file = file.path(), .wrap = BitmapWrap::clamp});
  CHECK(red(clamp, -5, 0.25f) == doctest::Approx(3));
  CHECK(red(clamp, 5, 9) == doctest::Approx(2));
  const Bitmap mirror({.file = file.path(), .wrap = BitmapWrap::mirror});
  CHECK(red(mirror, -0.25f, 0.25f) == doctest::Approx(3));
  CHECK(red(mirror, -0.75f, 0.25f) == doctest::Approx(4));
  CHECK(red(mirror, 1.25f, 0.25f) == doctest::Approx(4));
  CHECK(red(mirror, 2.25f, 0.25f) == doctest::Approx(3));
  for (const float u : {0.0f, 1.0f, -1.0f, 1e9f, -1e9f, 0.99999994f}) {
    CHECK(red(repeat, u, u) >= 1);
    CHECK(red(mirror, u, u) >= 1);
    CHECK(red(clamp, u, u) >= 1);
  }
}

TEST_CASE("bitmap: scale") {
  const ImageFile file("scale.exr", four_texels());
  const Bitmap texture(
      {.file = file.path(), .filter = BitmapFilter::nearest, .uv_scale = {0.5f, 2}});
  CHECK(red(texture, 1.5f, 0.125f) == 4);
  CHECK(red(texture, 0.5f, 0.375f) == 1);
}

TEST_CASE("bitmap: encoding of 8-bit images") {
  Image image(1, 1, {"R", "G", "B"});
  image.set_rgb(0, 0, Rgb(0.2f));
  const ImageFile file("encoding.png", image);
  const Bitmap srgb({.file = file.path()});
  CHECK(red(srgb, 0.5f, 0.5f) == doctest::Approx(0.2).epsilon(0.02));
  const Bitmap linear({.file = file.path(), .color_space = ColorSpace::linear});
  CHECK(red(linear, 0.5f, 0.5f) == doctest::Approx(srgb_from_linear(0.2f)).epsilon(0.01));
}

TEST_CASE("bitmap: channels go by their names") {
  Image image(1, 1, {"A", "B", "G", "R"});
  const float values[] = {9, 3, 2, 1};
  std::copy(std::begin(values), std::end(values), image.pixel(0, 0));
  const ImageFile file("names.exr", image);
  CHECK(Bitmap({.file = file.path()}).average() == Rgb(1, 2, 3));
}

TEST_CASE("bitmap: gray images") {
  Image image(1, 1, {"Y"});
  *image.pixel(0, 0) = 0.75f;
  const ImageFile file("gray.exr", image);
  CHECK(Bitmap({.file = file.path()}).average() == Rgb(0.75f));
}

TEST_CASE("bitmap: bad files") {
  CHECK_THROWS_AS(Bitmap({.file = "no-such-file.exr"}), InputError);
  Image image(1, 1, {"R", "G", "B"});
  image.set_rgb(0, 0, {0.5f, -1, 0});
  const ImageFile file("negative.exr", image);
  CHECK_THROWS_AS(Bitmap({.file = file.path()}), InputError);
}

}  // namespace pharos

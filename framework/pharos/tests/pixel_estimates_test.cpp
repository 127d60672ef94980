#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/guiding/toolkit/pixel_estimates.h>

namespace pharos {
namespace {

TEST_CASE("pixel estimates: pixels are averaged with their neighbors") {
  PixelEstimates pixels({4, 2, 7, 3});
  pixels.add({4.5f, 2.5f}, 3);
  pixels.add({5.5f, 2.5f}, 1);
  pixels.update(1, 1e-6);
  CHECK(pixels.at({4.2f, 2.9f}) == doctest::Approx(2));
  CHECK(pixels.at({5.2f, 2.9f}) == doctest::Approx(2));
  CHECK(pixels.at({6.2f, 2.9f}) == doctest::Approx(1));
  CHECK(pixels.at({99, 99}) == pixels.at({6.2f, 2.9f}));
}

TEST_CASE("pixel estimates: saved and loaded, they go on as before; other windows are refused") {
  PixelEstimates pixels({4, 2, 7, 3});
  pixels.add({4.5f, 2.5f}, 3);
  pixels.update(1, 1e-6);
  pixels.add({4.5f, 2.5f}, 1);
  std::stringstream file;
  save(file, pixels);
  std::stringstream again(file.str());
  PixelEstimates same({4, 2, 7, 3}), other({0, 0, 3, 1});
  load(file, same);
  CHECK(same.at({4.5f, 2.5f}) == doctest::Approx(3));
  CHECK(same.mean() == doctest::Approx(3));
  same.update(1, 1e-6);
  CHECK(same.at({4.5f, 2.5f}) == doctest::Approx(2));
  CHECK_THROWS_AS(load(again, other), InputError);
}

TEST_CASE("pixel estimates: the mean of the image, and paths whose pixel was chosen more often") {
  PixelEstimates pixels({0, 0, 2, 1});
  pixels.update(0, 1e-6);
  CHECK(pixels.mean() == 1);
  CHECK(pixels.at({0.5f, 0.5f}) == 1);
  // Both pixels have the value 4. The first one is chosen three times, so that its paths have a
  // third of the value.
  for (int i = 0; i < 3; ++i) pixels.add({0.5f, 0.5f}, 4.0 / 3, 1.0 / 3);
  pixels.add({1.5f, 0.5f}, 4);
  pixels.update(0, 1e-6);
  CHECK(pixels.at({0.5f, 0.5f}) == doctest::Approx(4));
  CHECK(pixels.at({1.5f, 0.5f}) == doctest::Approx(4));
  CHECK(pixels.mean() == doctest::Approx(4));
}

}  // namespace
}  // namespace pharos

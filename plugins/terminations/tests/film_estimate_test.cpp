#include "../film_estimate.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "../image_error.h"

namespace pharos {
namespace {

constexpr PixelRect kWindow{10, 20, 26, 32};

Vec2 center(int x, int y) {
  return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

/// An image of mean `left` and `right` of its middle, where the reflectance changes, too. Its noise
/// is as large as the image.
FilmEstimate two_halves(double left, double right) {
  FilmEstimate film(kWindow);
  RandomStream random(4);
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) {
      const bool is_left = x < 18;
      const double value = (is_left ? left : right) * 2 * random.next_1d();
      film.add(center(x, y), {value, 1, Rgb(is_left ? 0.2f : 0.8f), {0, 0, 1}});
    }
  }
  return film;
}

}  // namespace

TEST_CASE("film estimate: the filter lowers the noise and keeps edges of reflectance") {
  const FilmEstimate film = two_halves(1, 5);
  const PixelMap noisy = film.denoised({.levels = 0}), smooth = film.denoised({.levels = 2});
  const auto error = [](const PixelMap& map) {
    double sum = 0;
    for (int y = kWindow.y0; y < kWindow.y1; ++y) {
      for (int x = kWindow.x0; x < kWindow.x1; ++x) {
        sum += std::pow(map.at(center(x, y)) / (x < 18 ? 1 : 5) - 1, 2);
      }
    }
    return sum / static_cast<double>(kWindow.area());
  };
  CHECK(error(noisy) == doctest::Approx(1.0 / 3).epsilon(0.2));
  CHECK(error(smooth) < 0.02);
  CHECK(film.mean() == doctest::Approx(3).epsilon(0.1));
}

TEST_CASE("film estimate: pixels without paths take the radiance of their neighbors") {
  FilmEstimate film({0, 0, 9, 1});
  film.add({0.5f, 0.5f}, {6, 2, Rgb(), {}});
  const PixelMap map = film.denoised({.levels = 1});
  CHECK(map.at({0, 0}) == 3);
  CHECK(map.at({2, 0}) == 3);
  CHECK(map.at({3, 0}) == 0);
  CHECK(map.at({-7, 0}) == 3);
}

TEST_CASE("film estimate: paths with undefined features count without them") {
  FilmEstimate film({0, 0, 2, 1});
  film.add({0.5f, 0.5f}, {4, 1, Rgb(0.5f), {0, 0, 1}});
  film.add({0.5f, 0.5f}, {2, 1, Rgb(0.5f), {0, 0, NAN}});
  film.add({0.5f, 0.5f}, {0, 1, Rgb(NAN), {0, 0, 1}});
  CHECK(film.denoised({.levels = 2}).at({0.5f, 0.5f}) == doctest::Approx(2));
}

TEST_CASE("image error: outliers count as the smallest one of them") {
  ImageError error(2, 100);
  CHECK(error.squared() == 0);
  for (const double squared : {3.0, 100.0, 1.0, 2.0, 50.0}) error.add(squared, 2 * squared);
  CHECK(error.squared() == doctest::Approx((3 + 50 + 1 + 2 + 50) / 5.0));
  CHECK(error.cost() == doctest::Approx(2 * (3 + 100 + 1 + 2 + 50) / 5.0));
  error.clear();
  CHECK(error.squared() == 0);
  CHECK(error.cost() == 0);
}

TEST_CASE("image error: each pass has as many outliers, and a limit of its own") {
  ImageError error(2, 4);
  CHECK(error.largest() == 0);
  for (const double squared : {1.0, 100.0, 2.0, 5.0, 6.0, 70.0, 3.0, 9.0}) error.add(squared, 1);
  CHECK(error.largest() == doctest::Approx((5 + 9) / 2.0));
  CHECK(error.squared() == doctest::Approx((1 + 2 + 2 * 5 + 6 + 3 + 2 * 9) / 8.0));
  error.add(50, 1);  // the only path of its pass
  CHECK(error.largest() == doctest::Approx((5 + 9) / 2.0));
  CHECK(error.squared() == doctest::Approx((40 + 50) / 9.0));
}

TEST_CASE("image error: without outliers all paths count") {
  ImageError error(0, 1);
  for (const double squared : {1.0, 100.0}) error.add(squared, 1);
  CHECK(error.squared() == doctest::Approx(50.5));
  CHECK(error.largest() == 0);
}

}  // namespace pharos

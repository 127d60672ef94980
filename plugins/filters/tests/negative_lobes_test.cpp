// A film with a filter that has negative weights.

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/rendering/film.h>

#include "../mitchell.h"

namespace pharos {
namespace {

constexpr int kSize = 12;
constexpr PixelRect kAll{0, 0, kSize, kSize};

Film make_film(float b, float c) {
  return {kSize, kSize, std::make_shared<MitchellFilter>(MitchellFilter::Settings{.b = b, .c = c})};
}

/// Adds one pass of `n` samples per pixel to `pixels`, with the values value(film position,
/// random).
template <class Value>
void add_pass(Film& film, int n, RandomStream& random, Value&& value, PixelRect pixels = kAll) {
  FilmTile tile = film.make_tile(pixels);
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      for (int i = 0; i < n; ++i) {
        const Vec2 u = random.next_2d();
        const Vec2 at{static_cast<float>(x) + u.x, static_cast<float>(y) + u.y};
        tile.add_sample(at, Rgb(value(at, random)), {});
      }
    }
  }
  film.merge(tile);
  film.end_pass(n, pixels.area() == kAll.area());
}

/// The largest magnitude of a pixel; infinite if any pixel is not finite.
float largest(const Image& image) {
  float value = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float v = image.rgb(x, y).r;
      value = std::isfinite(v) ? std::max(value, std::abs(v)) : kInfinity;
    }
  }
  return value;
}

TEST_CASE("negative lobes: a constant stays a constant, at the edges too") {
  Film film = make_film(0, 0.5f);
  RandomStream random(1);
  add_pass(film, 4, random, [](Vec2, RandomStream&) { return 3.0f; });
  const Image image = film.layers();
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) CHECK(image.rgb(x, y).g == doctest::Approx(3));
  }
}

/// The integral of Mitchell and Netravali's cubic with B = C = 1/3 from `start` to its end.
double share_beyond(float start) {
  const MitchellFilter filter({});
  constexpr int kSteps = 4000;
  const float step = (2 - start) / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    sum += filter.evaluate({start + (static_cast<float>(i) + 0.5f) * step, 0}) * step;
  }
  return sum / std::sqrt(filter.evaluate({0, 0}));
}

TEST_CASE("negative lobes: an edge over- and undershoots as the integral of the cubic says") {
  constexpr int kEdge = 6, kSteps = 32;
  Film film = make_film(1.0f / 3, 1.0f / 3);
  FilmTile tile = film.make_tile(kAll);
  for (int y = 0; y < kSteps * kSize; ++y) {
    for (int x = 0; x < kSteps * kSize; ++x) {
      const Vec2 at{(static_cast<float>(x) + 0.5f) / kSteps,
                    (static_cast<float>(y) + 0.5f) / kSteps};
      tile.add_sample(at, Rgb(at.x > kEdge ? 1 : 0), {});
    }
  }
  film.merge(tile);
  film.end_pass(square(kSteps));
  const Image image = film.layers();
  for (const int y : {0, 5, kSize - 1}) {
    CHECK(image.rgb(kEdge - 2, y).r == doctest::Approx(share_beyond(1.5f)).epsilon(1e-3).scale(1));
    CHECK(image.rgb(kEdge - 1, y).r == doctest::Approx(share_beyond(0.5f)).epsilon(1e-3).scale(1));
    CHECK(image.rgb(kEdge + 1, y).r == doctest::Approx(1 - share_beyond(1.5f)).epsilon(1e-3));
    CHECK(image.rgb(kEdge - 2, y).r < -0.005f);
  }
}

TEST_CASE("negative lobes: single samples whose weights cancel do not blow up") {
  RandomStream random(3);
  const auto value = [](Vec2, RandomStream& r) { return r.next_1d(); };
  float highest = 0, variance = 0;
  for (int run = 0; run < 100; ++run) {
    Film film = make_film(0, 1);
    add_pass(film, 1, random, value);
    highest = std::max(highest, largest(film.layers()));
    add_pass(film, 1, random, value);
    const Image image = film.layers();
    for (int i = 0; i < kSize * kSize; ++i) {
      variance = std::max(variance, image.pixel(i % kSize, i / kSize)[10]);
    }
  }
  // The limit is ten times the brightest sample; the variance of the mean of two such values is at
  // most (20 / 2)^2.
  CHECK(highest <= 10);
  CHECK(highest > 1);
  CHECK(variance <= 100);
}

TEST_CASE("negative lobes: pixels that a first pass cut short left to their neighbors' lobes") {
  RandomStream random(4);
  for (int run = 0; run < 50; ++run) {
    Film film = make_film(0, 0.5f);
    add_pass(film, 1, random, [](Vec2, RandomStream& r) { return r.next_1d(); }, {0, 0, 5, 5});
    CHECK(largest(film.layers()) <= 10);
  }
}

TEST_CASE("negative lobes: the variance layer is the variance of the image") {
  RandomStream random(5);
  constexpr int kRuns = 300, kPasses = 8;
  std::vector<double> sums(kSize * kSize), squares(kSize * kSize);
  double stated = 0;
  for (int run = 0; run < kRuns; ++run) {
    Film film = make_film(1.0f / 3, 1.0f / 3);
    for (int pass = 0; pass < kPasses; ++pass) {
      add_pass(film, 4, random, [](Vec2, RandomStream& r) { return r.next_1d(); });
    }
    const Image image = film.layers();
    for (int i = 0; i < kSize * kSize; ++i) {
      const float* pixel = image.pixel(i % kSize, i / kSize);
      sums[i] += pixel[0];
      squares[i] += square(double{pixel[0]});
      stated += pixel[10] / kRuns;
    }
  }
  double actual = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    actual += (squares[i] - sums[i] * sums[i] / kRuns) / (kRuns - 1);
  }
  // The sums of 144 x 300 estimates spread by about 1 %. A pass of few samples states slightly more
  // than its share of the whole, as is true of every quotient of random sums.
  CHECK(stated == doctest::Approx(actual).epsilon(0.05));
}

TEST_CASE("negative lobes: evenly strewn splats make an even image, at the borders too") {
  Film film = make_film(1.0f / 3, 1.0f / 3);
  FilmTile tile = film.make_tile(kAll);
  RandomStream random(6);
  constexpr int kPaths = 400000;
  for (int i = 0; i < kPaths; ++i) {
    tile.add_splat(static_cast<float>(kSize) * random.next_2d(), Rgb(kSize * kSize));
  }
  tile.count_paths(kPaths);
  film.merge(tile);
  film.end_pass(1);
  const Image image = film.layers();
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) CHECK(image.rgb(x, y).r == doctest::Approx(1).epsilon(0.08));
  }
}

}  // namespace
}  // namespace pharos

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/image_combiner.h>

namespace pharos {
namespace {

class Tent final : public Filter {
 public:
  explicit Tent(float radius) : radius_(radius) {}
  float radius() const override { return radius_; }
  float evaluate(Vec2 o) const override {
    return std::max(0.0f, radius_ - std::abs(o.x)) * std::max(0.0f, radius_ - std::abs(o.y));
  }
  float integral() const override { return square(square(radius_)); }

 private:
  float radius_;
};

class Box final : public Filter {
 public:
  float radius() const override { return 0.5f; }
  float evaluate(Vec2) const override { return 1; }
  float integral() const override { return 1; }
};

constexpr int kSize = 8;
constexpr PixelRect kAll{0, 0, kSize, kSize};

/// Adds one pass of `n` samples per pixel with the values value(film position, random).
template <class Value>
void add_pass(Film& film, int n, std::uint64_t seed, Value&& value) {
  FilmTile tile = film.make_tile(kAll);
  RandomStream random(seed);
  for (int i = 0; i < n * kSize * kSize; ++i) {
    const int pixel = i % (kSize * kSize);
    const Vec2 u = random.next_2d();
    const Vec2 at{static_cast<float>(pixel % kSize) + u.x, static_cast<float>(pixel / kSize) + u.y};
    tile.add_sample(at, value(at, random), {.depth = 2});
  }
  film.merge(tile);
  film.end_pass(n);
}

TEST_CASE("radiance without a path counts in the color alone") {
  Film film(kSize, kSize, std::make_shared<Box>());
  FilmTile tile = film.make_tile(kAll);
  tile.add_radiance({2.5f, 3.5f}, Rgb(9));
  film.merge(tile);
  add_pass(film, 3, 1, [](Vec2, RandomStream&) { return Rgb(1); });
  const Image image = film.layers();
  CHECK(image.rgb(2, 3).g == doctest::Approx(3));
  CHECK(image.rgb(3, 3).g == doctest::Approx(1));
  CHECK(image.pixel(2, 3)[image.channel_index("samples.N")] == 3);
  CHECK(image.pixel(2, 3)[image.channel_index("depth.Z")] == doctest::Approx(2));
}

TEST_CASE("a constant stays a constant under any filter, at the edges too") {
  for (const float radius : {0.5f, 1.3f, 2.0f}) {
    Film film(kSize, kSize, std::make_shared<Tent>(radius));
    add_pass(film, 4, 1, [](Vec2, RandomStream&) { return Rgb(3); });
    const Image image = film.layers();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) CHECK(image.rgb(x, y).g == doctest::Approx(3));
    }
    CHECK(image.pixel(3, 3)[image.channel_index("samples.N")] == 4);
    CHECK(image.pixel(3, 3)[image.channel_index("depth.Z")] == doctest::Approx(2));
  }
}

TEST_CASE("samples fall into the pixel they are in") {
  Film film(kSize, kSize, std::make_shared<Box>());
  add_pass(film, 1, 1,
           [](Vec2 at, RandomStream&) { return Rgb(std::floor(at.x), std::floor(at.y), 0); });
  const Image image = film.layers();
  CHECK(image.rgb(5, 2) == Rgb(5, 2, 0));
}

TEST_CASE("splats keep their sum, and are divided by all paths") {
  for (const float radius : {0.5f, 1.5f}) {
    Film film(kSize, kSize, std::make_shared<Tent>(radius));
    FilmTile tile = film.make_tile({0, 0, 4, 4});
    RandomStream random(3);
    for (int i = 0; i < 20000; ++i) {
      const Vec2 u = random.next_2d();
      // Splats fall anywhere on the film except near its edge, where filters lose a part of them.
      tile.add_splat({2 + 4 * u.x, 2 + 4 * u.y}, Rgb(8));
    }
    tile.count_paths(1000);
    film.merge(tile);
    film.end_pass(1);
    double sum = 0;
    const Image image = film.layers();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) sum += image.rgb(x, y).r;
    }
    CHECK(sum == doctest::Approx(20000 * 8 / 1000.0).epsilon(0.01));
  }
}

TEST_CASE("evenly spread splats make an even image, at the borders too") {
  // On a fine grid, so that an error of a tenth of a percent in the border's norms would be seen.
  constexpr int kFine = 64;
  for (const float radius : {0.5f, 1.3f, 1.5f, 2.0f}) {
    CAPTURE(radius);
    Film film(kSize, kSize, std::make_shared<Tent>(radius));
    FilmTile tile = film.make_tile(kAll);
    for (int y = 0; y < kSize * kFine; ++y) {
      for (int x = 0; x < kSize * kFine; ++x) {
        const Vec2 at{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
        tile.add_splat((1.0f / kFine) * at, Rgb(kSize * kSize));
      }
    }
    tile.count_paths(kSize * kFine * kSize * kFine);
    film.merge(tile);
    film.end_pass(1);
    const Image image = film.layers();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        CHECK(image.rgb(x, y).r == doctest::Approx(1).epsilon(0.001));
      }
    }
  }
}

TEST_CASE("a pass with splats that was cut short is dropped") {
  Film film(kSize, kSize, std::make_shared<Box>());
  for (const bool complete : {true, false}) {
    FilmTile tile = film.make_tile(kAll);
    tile.add_splat({1.5f, 1.5f}, Rgb(complete ? 1 : 100));
    tile.count_paths(1);
    film.merge(tile);
    film.end_pass(1, complete);
  }
  CHECK(film.layers().rgb(1, 1) == Rgb(1));
  CHECK(film.samples_per_pixel() == 1);
}

TEST_CASE("the variance layer is the variance of the mean, also with passes of different size") {
  Film film(kSize, kSize, std::make_shared<Box>());
  int samples = 0;
  for (std::uint64_t pass = 0; pass < 200; ++pass) {
    const int n = pass % 3 == 0 ? 1 : 4;
    samples += n;
    add_pass(film, n, pass, [](Vec2, RandomStream& random) { return Rgb(random.next_1d()); });
  }
  double variance = 0;
  const Image image = film.layers();
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      variance += image.pixel(x, y)[image.channel_index("variance.G")] / (kSize * kSize);
    }
  }
  CHECK(variance == doctest::Approx(1.0 / 12 / samples).epsilon(0.05));
}

TEST_CASE("merged films are one film") {
  const auto value = [](Vec2, RandomStream& random) { return Rgb(random.next_1d()); };
  Film whole(kSize, kSize, std::make_shared<Tent>(1)), first = whole, second = whole;
  for (std::uint64_t pass = 0; pass < 6; ++pass) {
    add_pass(whole, 2, pass, value);
    add_pass(pass < 2 ? first : second, 2, pass, value);
  }
  first.merge(second);
  const Image a = whole.layers(), b = first.layers();
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    REQUIRE(a.values()[i] == doctest::Approx(b.values()[i]).epsilon(1e-3));
  }
}

TEST_CASE("the mean number of steps counts all samples of ended passes") {
  Film film(kSize, kSize, std::make_shared<Box>());
  CHECK(film.mean_cost() == 0);
  FilmTile tile = film.make_tile(kAll);
  tile.add_sample({2.5f, 3.5f}, Rgb(), {.cost = 3});
  tile.add_sample({4.5f, 3.5f}, Rgb(), {.cost = 8});
  tile.add_features({4.5f, 1.5f}, {.cost = 4});
  film.merge(tile);
  CHECK(film.mean_cost() == 0);
  film.end_pass(1);
  CHECK(film.mean_cost() == doctest::Approx(5));
}

TEST_CASE("factors of vertices are averaged over the vertices of a pixel, not over its samples") {
  Film film(kSize, kSize, std::make_shared<Box>());
  FilmTile tile = film.make_tile(kAll);
  Features splits, ends;
  splits.splitting[0].add(2.5f);
  for (const float factor : {0.5f, 2.0f, 0.5f}) splits.splitting[1].add(factor);
  ends.splitting[0].add(0.5f);
  tile.add_sample({2.5f, 3.5f}, Rgb(), splits);
  tile.add_sample({2.5f, 3.5f}, Rgb(), ends);
  tile.add_sample({2.5f, 3.5f}, Rgb(), {});  // sees nothing
  film.merge(tile);
  film.end_pass(1);
  const Image image = film.layers();
  const auto layer = [&](int x, const char* name) {
    return image.pixel(x, 3)[image.channel_index(name)];
  };
  CHECK(layer(2, "splitting.1") == doctest::Approx(1.5));
  CHECK(layer(2, "splitting.2") == doctest::Approx(1));
  CHECK(layer(5, "splitting.1") == 0);
}

TEST_CASE("selected layers follow the color") {
  Film film(kSize, kSize, std::make_shared<Box>());
  add_pass(film, 2, 1, [](Vec2, RandomStream&) { return Rgb(1); });
  CHECK(select_layers(film.layers(), {Layer::splitting, Layer::cost}).channels() ==
        std::vector<std::string>{"R", "G", "B", "splitting.1", "splitting.2", "cost.N"});
  const Image image = select_layers(film.layers(), {Layer::depth, Layer::samples});
  CHECK(image.channels() == std::vector<std::string>{"R", "G", "B", "depth.Z", "samples.N"});
  CHECK(image.pixel(0, 0)[4] == 2);
}

/// Returns a film of mean one after `passes` passes. The noise of one pass has the standard
/// deviation `sigma`.
Film noisy(float sigma, std::uint64_t passes, std::uint64_t seed) {
  Film film(kSize, kSize, std::make_shared<Box>());
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    add_pass(film, 1, 1000 * seed + pass, [&](Vec2, RandomStream& random) {
      return Rgb(1 + sigma * std::sqrt(12.0f) * (random.next_1d() - 0.5f));
    });
  }
  return film;
}

TEST_CASE("images combine by when their samples were taken, whatever their variance") {
  double mean_value = 0, squares = 0, stated = 0;
  const int runs = 200;
  const double pixels = runs * kSize * kSize;
  for (int run = 0; run < runs; ++run) {
    ImageCombiner combiner(2);
    combiner.add(noisy(1, 48, static_cast<std::uint64_t>(2 * run)), {0, 48});
    combiner.add(noisy(0.5f, 16, static_cast<std::uint64_t>(2 * run + 1)), {48, 64});
    const Image image = combiner.combine();
    const double v = image.rgb(4, 4).r;
    mean_value += v / runs;
    const int variance = image.channel_index("variance.R");
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        squares += std::pow(image.rgb(x, y).r - 1, 2) / pixels;
        stated += image.pixel(x, y)[variance] / pixels;
      }
    }
    CHECK(image.pixel(4, 4)[image.channel_index("samples.N")] == 64);
  }
  // The first 8 of 64 samples have half of the full weight on average.
  constexpr double kVariance = (44.0 * 44 / 48 * 1.0 + 16 * 0.25) / (60 * 60);
  CHECK(mean_value == doctest::Approx(1).epsilon(0.03));
  CHECK(squares == doctest::Approx(kVariance).epsilon(0.1).scale(0));
  CHECK(stated == doctest::Approx(kVariance).epsilon(0.1).scale(0));
}

/// Returns a film of one value with `passes` samples per pixel.
Film flat(float value, std::uint64_t passes) {
  Film film(kSize, kSize, std::make_shared<Box>());
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    add_pass(film, 1, pass, [&](Vec2, RandomStream&) { return Rgb(value); });
  }
  return film;
}

TEST_CASE("images of guides that know little count less, and only the latest are combined") {
  // Sample s of 32 has the weight min(1, s / 4). The sums of the images' weights are 0.5, 1.5 and
  // 28.
  const auto combined = [](std::uint32_t latest) {
    ImageCombiner combiner(latest);
    combiner.add(flat(1, 2), {0, 2});
    combiner.add(flat(2, 2), {2, 4});
    combiner.add(flat(3, 28), {4, 32});
    return combiner.combine().rgb(2, 3).r;
  };
  CHECK(combined(3) == doctest::Approx((0.5 + 1.5 * 2 + 28 * 3) / 30));
  CHECK(combined(2) == doctest::Approx((1.5 * 2 + 28 * 3) / 29.5));
  CHECK(combined(1) == doctest::Approx(3));
}

TEST_CASE("images combine by the time that they took, whatever their number of samples") {
  // Each sample of the second image costs as much as ten samples of the first one.
  ImageCombiner combiner(2);
  combiner.add(flat(1, 40), {0, 4});
  combiner.add(flat(2, 4), {4, 8});
  // Second s of 8 has the weight min(1, s). The sums of the images' weights are 3.5 and 4.
  CHECK(combiner.combine().rgb(2, 3).r == doctest::Approx((3.5 + 2 * 4) / 7.5));
}

TEST_CASE("an image of a single pass has the variance of the last image per sample") {
  ImageCombiner combiner(2);
  const Film single = noisy(1, 1, 1), many = noisy(1, 15, 2);
  combiner.add(single, {0, 1});
  combiner.add(many, {1, 16});
  const Image last = many.layers(), image = combiner.combine();
  const int variance = image.channel_index("variance.R");
  CHECK(std::isinf(single.layers().pixel(4, 4)[variance]));
  const double per_sample = 15.0 * last.pixel(4, 4)[variance];
  const double first_weight = 0.25, total_weight = 15;
  const double expected = (first_weight * first_weight +
                           (total_weight - first_weight) * (total_weight - first_weight) / 15) *
                          per_sample / (total_weight * total_weight);
  CHECK(image.pixel(4, 4)[variance] == doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("the sum of the weights does not depend on where training ends") {
  // A training may end at any time because of what it found. The sum of the weights, with which the
  // combination is divided, must not know. A bright first sample shows its weight.
  const auto weight_of_first = [](std::uint32_t training) {
    ImageCombiner combiner(3);
    combiner.add(flat(1, 1), {0, 1});
    combiner.add(flat(0, training), {1, 1.0 + training});
    combiner.add(flat(0, 63 - training), {1.0 + training, 64});
    return combiner.combine().rgb(2, 3).r;
  };
  for (const std::uint64_t training : {1u, 2u, 3u, 10u, 40u}) {
    CHECK(weight_of_first(training) == doctest::Approx(weight_of_first(62)).epsilon(1e-4).scale(0));
  }
}

}  // namespace
}  // namespace pharos

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/saved_bytes.h>
#include <pharos/rendering/pixel_noise.h>

namespace pharos {
namespace {

class Tent final : public Filter {
 public:
  float radius() const override { return 1.5f; }
  float evaluate(Vec2 o) const override {
    return std::max(0.0f, 1.5f - std::abs(o.x)) * std::max(0.0f, 1.5f - std::abs(o.y));
  }
  float integral() const override { return square(square(1.5f)); }
};

class Box final : public Filter {
 public:
  float radius() const override { return 0.5f; }
  float evaluate(Vec2) const override { return 1; }
  float integral() const override { return 1; }
};

constexpr PixelRect kWindow{2, 3, 34, 35};

/// Returns the film of an iteration of `samples` samples per pixel, whose values are
/// value(x, y, number in [0, 1)).
template <class Value>
Film film_with(int samples, std::uint64_t seed, Value&& value) {
  Film film(kWindow, std::make_shared<Box>());
  FilmTile tile = film.make_tile(kWindow);
  RandomStream random(seed);
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) {
      for (int i = 0; i < samples; ++i) {
        const Vec2 at{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
        tile.add_sample(at, Rgb(value(x, y, random.next_1d())), {});
      }
    }
  }
  film.merge(tile);
  film.end_pass(samples);
  return film;
}

double mean_share(const PixelShares& shares) {
  double sum = 0;
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) sum += shares.at(x, y);
  }
  return sum / static_cast<double>(kWindow.area());
}

constexpr int kLeft = kWindow.x0 + 4, kRight = kWindow.x1 - 5, kMiddle = 18;

TEST_CASE("even shares give every pixel the mean") {
  const PixelShares even;
  CHECK(even.count(5, 6, 0) == 0);
  CHECK(even.count(5, 6, 7) == 7);
}

TEST_CASE("counts follow the shares, in whole samples, and one at least") {
  const PixelShares shares({1, 1, 4, 2}, {0.2f, 0.8f, 2});
  CHECK(shares.count(1, 1, 0) == 0);
  CHECK(shares.count(1, 1, 1) == 1);
  CHECK(shares.count(1, 1, 100) == 20);
  CHECK(shares.count(2, 1, 100) == 80);
  CHECK(shares.count(3, 1, 100) == 200);
}

TEST_CASE("shares are saved and loaded, and damaged ones refused") {
  PixelShares shares({1, 1, 4, 2}, {0.2f, 0.8f, 2}), loaded;
  const auto save = [](PixelShares& s) {
    return saved_bytes([&](Archive& archive) { archive(s); });
  };
  load_bytes(save(shares), [&](Archive& archive) { archive(loaded); });
  CHECK(loaded.at(3, 1) == 2);
  PixelShares zero({1, 1, 4, 2}, {0.2f, 0, 2}), short_one({1, 1, 4, 2}, {1, 1});
  for (PixelShares* wrong : {&zero, &short_one}) {
    CHECK_THROWS_AS(load_bytes(save(*wrong), [&](Archive& archive) { archive(loaded); }),
                    InputError);
  }
}

TEST_CASE("noise: pixels are alike as long as nothing is known") {
  PixelNoise noise;
  CHECK(noise.shares().are_even());
  noise.add(film_with(1, 1, [](int, int, float u) { return u; }));
  CHECK(noise.shares().are_even());  // a single sample has no spread
  noise.add(film_with(3, 1, [](int, int, float) { return 1.0f; }));
  CHECK_FALSE(noise.shares().are_even());
}

TEST_CASE("noise: half of the samples go where the deviations are, relative to the brightness") {
  PixelNoise noise;
  // The left half has no noise. In the right half, values are 0 or 2.
  noise.add(film_with(16, 1, [](int x, int, float u) {
    return x < kMiddle || u < 0.5f ? (x < kMiddle ? 1.0f : 0.0f) : 2.0f;
  }));
  const PixelShares shares = noise.shares();
  CHECK(mean_share(shares) == doctest::Approx(1));
  CHECK(shares.at(kLeft, 20) == doctest::Approx(0.5).epsilon(0.02));
  CHECK(shares.at(kRight, 20) == doctest::Approx(1.5).epsilon(0.1));

  // Both halves have the same relative deviation. Four times the brightness is twice the share.
  PixelNoise bright;
  bright.add(film_with(64, 2, [](int x, int, float u) {
    return (x < kMiddle ? 1.0f : 4.0f) * (u < 0.5f ? 0.5f : 1.5f);
  }));
  const PixelShares by_brightness = bright.shares();
  const double left = by_brightness.at(kLeft, 20) - 0.5, right = by_brightness.at(kRight, 20) - 0.5;
  // (0.1 times the mean brightness of 2.5 is added to the brightness.)
  CHECK(right / left == doctest::Approx(4 * std::sqrt(1.25 / 4.25)).epsilon(0.05));
}

TEST_CASE("noise: where few samples have found light, shares are even") {
  PixelNoise noise;
  noise.add(film_with(8, 1, [](int x, int y, float u) {
    return x % 16 == 9 && y % 16 == 9 && u < 0.1f ? 1000.0f : 0.0f;
  }));
  const PixelShares shares = noise.shares();
  CHECK_FALSE(shares.are_even());
  for (const int x : {kLeft, 9, kRight}) CHECK(shares.at(x, 9) == doctest::Approx(1));
}

TEST_CASE("noise: earlier iterations count less, and the state can be saved") {
  const auto noisy_if = [](bool left) {
    return [left](int x, int, float u) {
      return (x < kMiddle) == left ? (u < 0.5f ? 0.0f : 2.0f) : 1.0f;
    };
  };
  PixelNoise noise;
  noise.add(film_with(16, 1, noisy_if(true)));
  PixelNoise saved;
  load_bytes(saved_bytes([&](Archive& archive) { archive(noise); }),
             [&](Archive& archive) { archive(saved); });
  for (PixelNoise* n : {&noise, &saved}) n->add(film_with(16, 2, noisy_if(false)));
  const PixelShares shares = noise.shares();
  CHECK(shares.at(kRight, 20) == doctest::Approx(0.5 + 2.0 / 3).epsilon(0.03));
  // The standard deviation on the right is twice that on the left.
  CHECK((shares.at(kRight, 20) - 0.5f) / (shares.at(kLeft, 20) - 0.5f) ==
        doctest::Approx(2).epsilon(0.1));
  CHECK(saved.shares().at(kLeft, 20) == shares.at(kLeft, 20));
}

TEST_CASE("a pass without samples in a pixel does not make the pixel look noisy") {
  constexpr PixelRect all{0, 0, 2, 1};
  const PixelShares shares(all, {0.55f, 1.45f});
  Film film(all, std::make_shared<Box>());
  std::uint32_t done = 0;
  for (const std::uint32_t samples : {1, 1, 2, 4}) {
    FilmTile tile = film.make_tile(all, shares);
    for (int x = 0; x < 2; ++x) {
      const std::uint32_t end = shares.count(x, 0, done + samples);
      for (std::uint32_t i = shares.count(x, 0, done); i < end; ++i) {
        tile.add_sample({static_cast<float>(x) + 0.5f, 0.5f}, Rgb(3), {});
      }
    }
    film.merge(tile);
    film.end_pass(samples);
    done += samples;
  }
  const Image image = film.layers();
  for (int x = 0; x < 2; ++x) {
    CHECK(image.rgb(x, 0).g == 3);
    CHECK(image.pixel(x, 0)[image.channel_index("variance.G")] == 0);
  }
}

TEST_CASE("shares do not shift the light that a wide filter spreads") {
  // Brightness grows to the right, where pixels get up to 15 times the samples of the left ones.
  constexpr int kWidth = 8;
  constexpr PixelRect all{0, 0, kWidth, 1};
  std::vector<float> values;
  for (int x = 0; x < kWidth; ++x) values.push_back(0.125f + 0.25f * static_cast<float>(x));
  const PixelShares shares(all, values);
  Film film(all, std::make_shared<Tent>());
  FilmTile tile = film.make_tile(all, shares);
  RandomStream random(5);
  for (int x = 0; x < kWidth; ++x) {
    for (std::uint32_t i = 0; i < shares.count(x, 0, 20'000); ++i) {
      const Vec2 at{static_cast<float>(x) + random.next_1d(), random.next_1d()};
      tile.add_sample(at, Rgb(at.x), {});
    }
  }
  film.merge(tile);
  film.end_pass(20'000);
  const Image image = film.layers();
  for (int x = 2; x < kWidth - 2; ++x) {
    CHECK(image.rgb(x, 0).g == doctest::Approx(x + 0.5).epsilon(0.005));
  }
}

TEST_CASE("saved noise of a rectangle that cannot be is refused") {
  PixelNoise noise;
  noise.add(film_with(16, 1, [](int, int, float) { return 1.0f; }));
  const std::string bytes = saved_bytes([&](Archive& archive) { archive(noise); });
  const int low = std::numeric_limits<int>::min(), high = std::numeric_limits<int>::max();
  // A corner of four numbers; the upper one must not be below the lower one.
  for (const auto& [index, number] : {std::pair{0, low}, {1, -1}, {0, high}, {3, 0}, {2, high}}) {
    std::string damaged = bytes;
    std::memcpy(damaged.data() + index * sizeof number, &number, sizeof number);
    PixelNoise loaded;
    CHECK_THROWS_AS(load_bytes(damaged, [&](Archive& archive) { archive(loaded); }), InputError);
  }
}

}  // namespace
}  // namespace pharos

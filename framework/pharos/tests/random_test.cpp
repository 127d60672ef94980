#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>

using namespace pharos;

TEST_CASE("unit floats lie in [0, 1)") {
  CHECK(to_unit_float(0) == 0);
  CHECK(to_unit_float(~0u) == kOneMinusEpsilon);
  const Vec2 v = to_unit_vec2(0xffffffff'00000000ull);
  CHECK(v.x == kOneMinusEpsilon);
  CHECK(v.y == 0);
}

TEST_CASE("every input bit of the mixer flips about half of the output bits") {
  for (int bit = 0; bit < 64; ++bit) {
    double flipped = 0;
    constexpr int kCount = 512;
    for (std::uint64_t v = 1; v <= kCount; ++v) {
      flipped += std::popcount(mix_bits(v) ^ mix_bits(v ^ (1ull << bit)));
    }
    // The mean of 512 x 64 fair bits has a standard deviation of 0.177 bits.
    CHECK(std::abs(flipped / kCount - 32) < 1.0);
  }
}

TEST_CASE("streams are functions of their whole key") {
  const auto first = [](auto... key) { return RandomStream(key...)(); };
  CHECK(first(1, 2, 3, 4) == first(1, 2, 3, 4));
  std::set<std::uint64_t> values;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (std::uint64_t a = 0; a < 4; ++a) {
      for (std::uint64_t b = 0; b < 4; ++b) {
        for (std::uint64_t c = 0; c < 4; ++c) values.insert(first(seed, a, b, c));
      }
    }
  }
  CHECK(values.size() == 256);
}

TEST_CASE("the order of hashed words matters") {
  CHECK(hash_combine(hash_combine(0, 1), 2) != hash_combine(hash_combine(0, 2), 1));
}

TEST_CASE("neighboring keys give independent uniform numbers") {
  constexpr int kCells = 16, kCount = 64'000;
  std::vector<double> observed(kCells * kCells), expected(kCells * kCells, kCount / 256.0);
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const float x = RandomStream(1, i).next_1d(), y = RandomStream(1, i + 1).next_1d();
    observed[static_cast<int>(x * kCells) * kCells + static_cast<int>(y * kCells)] += 1;
  }
  CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-3);
}

TEST_CASE("pairs of one stream fill the square evenly") {
  constexpr int kCells = 16, kCount = 64'000;
  std::vector<double> observed(kCells * kCells), expected(kCells * kCells, kCount / 256.0);
  RandomStream random(42);
  for (int i = 0; i < kCount; ++i) {
    const Vec2 u = random.next_2d();
    observed[static_cast<int>(u.x * kCells) * kCells + static_cast<int>(u.y * kCells)] += 1;
  }
  CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-3);
}

TEST_CASE("a stream serves the standard library") {
  std::vector<int> values{1, 2, 3, 4, 5, 6, 7, 8};
  RandomStream random(1);
  std::shuffle(values.begin(), values.end(), random);
  CHECK(std::set<int>(values.begin(), values.end()).size() == 8);
}

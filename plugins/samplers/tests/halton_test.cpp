#include "../halton.h"

#include <array>
#include <cstdint>
#include <cstdlib>

#include <doctest/doctest.h>

#include "../digit_scramble.h"
#include "point_lists.h"

namespace pharos {
namespace {

std::uint32_t power(std::uint32_t base, int exponent) {
  std::uint32_t value = 1;
  for (; exponent > 0; --exponent) value *= base;
  return value;
}

constexpr Dimension kDimension{Purpose::bsdf_direction, 1};

}  // namespace

TEST_CASE("halton: j 6^k samples fill all elementary intervals of up to k digits") {
  for (const std::uint32_t planned : {2000u, 50'000u, 0u}) {
    const auto sampler = HaltonSampler().prepare({}, {.samples_per_pixel = planned}, nullptr);
    for (std::uint64_t pixel = 0; pixel < 3; ++pixel) {
      for (int k = 0; k <= 4; ++k) {
        for (const std::uint32_t j : {1u, 2u, 5u}) {
          const auto points =
              test::points_of(*sampler, {.index = pixel}, kDimension, j * power(6, k));
          for (int a = 0; a <= k; ++a) {
            for (int b = 0; b <= k; ++b) {
              CHECK(test::fills_grid(points, power(2, a), power(3, b)));
            }
          }
        }
      }
    }
  }
}

TEST_CASE("halton: blocks of 6^k samples have one in each cell of 2^-k by 3^-k") {
  const auto sampler = HaltonSampler().prepare({}, {.samples_per_pixel = 1296}, nullptr);
  for (std::uint32_t block = 0; block < 6; ++block) {
    const auto points = test::points_of(*sampler, {}, kDimension, 216, 216 * block);
    CHECK(test::fills_grid(points, 8, 27));
    // 216 is also a multiple of other products 2^a 3^b, so it fills other grids too.
    CHECK(test::fills_grid(points, 8, 9));
  }
}

TEST_CASE("halton: few planned samples make short sets") {
  const auto sampler = HaltonSampler().prepare({}, {.samples_per_pixel = 6}, nullptr);
  for (const std::uint32_t set : {0u, 5u}) {
    CHECK(test::fills_grid(test::points_of(*sampler, {}, kDimension, 216, 216 * set), 8, 27));
  }
}

TEST_CASE("halton: numbers in 1D are those of base 2") {
  const auto sampler = HaltonSampler().prepare({}, {.samples_per_pixel = 1296}, nullptr);
  for (int k = 0; k <= 4; ++k) {
    const auto numbers =
        test::numbers_of(*sampler, {.index = 4}, {Purpose::bsdf_choice, 1}, power(6, k));
    CHECK(test::fills_grid(numbers, power(2, k), 1));
  }
}

TEST_CASE("digit scrambles: a digit's image depends on itself and those before it") {
  const DigitScramble<3, 3, true> scramble(4);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::array<bool, 27> hit{};
    for (std::uint32_t v = 0; v < 27; ++v) {
      const std::uint32_t image = scramble(v, 5, seed);
      CHECK_FALSE(hit[image]);
      hit[image] = true;
      CHECK(image / 9 == scramble(v / 9 * 9, 5, seed) / 9);
      CHECK(image / 3 == scramble(v / 3 * 3, 5, seed) / 3);
    }
  }
}

TEST_CASE("digit scrambles: every image is as likely, over seeds and over nodes") {
  const DigitScramble<6, 2, true> scramble(4);
  std::array<int, 36> by_seed{}, by_node{};
  constexpr int kDraws = 36'000;
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    ++by_seed[scramble(7, 0, mix_bits(i))];
    ++by_node[scramble(7, i, 99)];
  }
  // The standard deviation of a count is 31.
  for (const int count : by_seed) CHECK(std::abs(count - 1000) < 150);
  for (const int count : by_node) CHECK(std::abs(count - 1000) < 150);
}

}  // namespace pharos

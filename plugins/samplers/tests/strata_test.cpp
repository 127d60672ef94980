// Samplers over grids of strata, and what they are made of.
#include "../strata.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>

#include "../multi_jittered.h"
#include "../stratified.h"
#include "point_lists.h"

namespace pharos {
namespace {

constexpr Dimension kDimension{Purpose::lens};

/// One of the samplers with sets of `samples`.
template <class S>
std::unique_ptr<const PreparedSampler> prepared(std::uint32_t samples) {
  return S().prepare({}, {.samples_per_pixel = samples}, nullptr);
}

}  // namespace

TEST_CASE("strata: grids are as square as the number of samples allows") {
  const auto is = [](std::uint32_t samples, std::uint32_t columns, std::uint32_t rows) {
    const StrataGrid grid = grid_of(samples);
    return grid.columns == columns && grid.rows == rows;
  };
  CHECK(is(1, 1, 1));
  CHECK(is(2, 1, 2));
  CHECK(is(16, 4, 4));
  CHECK(is(32, 4, 8));
  CHECK(is(48, 6, 8));
  CHECK(is(37, 6, 7));
  CHECK(is(65536, 256, 256));
  for (std::uint32_t samples = 1; samples <= SetPlace::kMostSamples; ++samples) {
    REQUIRE(grid_of(samples).cells() >= samples);
    REQUIRE(grid_of(samples).cells() <= SetPlace::kMostSamples);
    // Quotients by reciprocals err first, if anywhere, at the end of a row.
    const StrataGrid grid = grid_of(samples);
    const GridCells cells(grid);
    bool exact = true;
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      exact &= cells[row * grid.columns].row == row;
      exact &= cells[row * grid.columns + grid.columns - 1].row == row;
    }
    REQUIRE(exact);
  }
}

TEST_CASE("strata: permutations are bijections, and every image is as likely") {
  for (std::uint32_t count = 1; count <= 300; ++count) {
    std::vector<bool> hit(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t image = permuted(i, count, 0x12345678u * count);
      REQUIRE(image < count);
      CHECK_FALSE(hit[image]);
      hit[image] = true;
    }
  }
  std::vector<double> p_values;
  for (const std::uint32_t count : {2u, 4u, 7u, 16u, 37u}) {
    // The images of two indices together: all ordered pairs of different numbers.
    RandomStream random(count);
    std::vector<double> pairs(count * (count - 1));
    const std::size_t draws = 200 * pairs.size();
    for (std::size_t i = 0; i < draws; ++i) {
      const auto seed = static_cast<std::uint32_t>(random());
      const std::uint32_t a = permuted(0, count, seed), b = permuted(count - 1, count, seed);
      ++pairs[a * (count - 1) + b - (b > a ? 1 : 0)];
    }
    const std::vector<double> expected(pairs.size(), 200);
    double largest = 0;
    for (const double n : pairs) largest = std::max(largest, n);
    CAPTURE(count);
    CHECK(largest < 2 * 200);
    std::vector<double> images(count);
    for (std::size_t i = 0; i < pairs.size(); ++i) images[i / (count - 1)] += pairs[i];
    const std::vector<double> even(count, 200.0 * (count - 1));
    p_values.push_back(statistics::chi_square_test(images, even).p_value);
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("strata: drawn permutations are bijections, and every image is as likely") {
  for (const std::uint32_t count : {1u, 2u, 7u, 16u, 257u}) {
    const DrawnPermutations permutations(count);
    std::vector<std::uint32_t> images(count);
    constexpr std::uint32_t kSeeds = 2000;
    RandomStream random(count);
    for (std::uint32_t i = 0; i < kSeeds; ++i) {
      const auto seed = static_cast<std::uint32_t>(random());
      std::vector<std::uint32_t> hit(count);
      for (std::uint32_t index = 0; index < count; ++index) ++hit.at(permutations(index, seed));
      REQUIRE(std::all_of(hit.begin(), hit.end(), [](std::uint32_t n) { return n == 1; }));
      ++images[permutations(count / 2, seed)];
    }
    // Counts are binomial; five standard deviations.
    const double even = static_cast<double>(kSeeds) / count;
    for (const std::uint32_t n : images) CHECK(std::abs(n - even) <= 5 * std::sqrt(even) + 1);
  }
}

TEST_CASE("strata: numbers never leave their stratum by rounding") {
  for (const std::uint32_t count : {1u, 3u, 7u, 42u, 1000u, 65535u, 65536u, 531441u}) {
    const Strata strata(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double low = strata.at(i, 0), high = strata.at(i, ~0u);
      REQUIRE(low * count >= i);
      REQUIRE(high * count < i + 1);
      REQUIRE(high >= low);
    }
  }
}

TEST_CASE("stratified: every set has one sample in each cell") {
  for (const std::uint32_t samples : {1u, 16u, 32u, 35u, 1024u}) {
    const auto sampler = prepared<StratifiedSampler>(samples);
    const StrataGrid grid = grid_of(samples);
    for (std::uint64_t pixel = 0; pixel < 5; ++pixel) {
      for (const std::uint32_t set : {0u, 3u}) {
        const auto points =
            test::points_of(*sampler, {.index = pixel}, kDimension, samples, set * samples);
        CHECK(test::fills_grid(points, grid.columns, grid.rows));
      }
      CHECK(test::fills_grid(test::numbers_of(*sampler, {.index = pixel}, kDimension, samples),
                             samples, 1));
    }
  }
}

TEST_CASE("multi_jittered: every set fills cells, columns and rows") {
  for (const std::uint32_t samples : {1u, 16u, 32u, 35u, 1024u}) {
    const auto sampler = prepared<MultiJitteredSampler>(samples);
    const StrataGrid grid = grid_of(samples);
    for (std::uint64_t pixel = 0; pixel < 5; ++pixel) {
      for (const std::uint32_t set : {0u, 3u}) {
        const auto points =
            test::points_of(*sampler, {.index = pixel}, kDimension, samples, set * samples);
        CHECK(test::fills_grid(points, grid.columns, grid.rows));
        CHECK(test::fills_grid(points, samples, 1));
        CHECK(test::fills_grid(points, 1, samples));
      }
      CHECK(test::fills_grid(test::numbers_of(*sampler, {.index = pixel}, kDimension, samples),
                             samples, 1));
    }
  }
}

TEST_CASE("multi_jittered: all columns share the permutation of their rows") {
  const auto sampler = prepared<MultiJitteredSampler>(64);
  std::vector<std::uint32_t> place_of_row(8, 8);
  for (const Vec2 p : test::points_of(*sampler, {}, kDimension, 64)) {
    const auto row = static_cast<std::size_t>(p.y * 8);
    const std::uint32_t place = static_cast<std::uint32_t>(p.x * 64) % 8;
    if (place_of_row[row] == 8) place_of_row[row] = place;
    CHECK(place_of_row[row] == place);
  }
}

TEST_CASE("multi_jittered: uncorrelated ones fill columns and rows, each in its own way") {
  const auto sampler =
      MultiJitteredSampler({.samples = 64, .correlated = false}).prepare({}, {}, nullptr);
  const auto points = test::points_of(*sampler, {}, kDimension, 64);
  CHECK(test::fills_grid(points, 8, 8));
  CHECK(test::fills_grid(points, 64, 1));
  CHECK(test::fills_grid(points, 1, 64));
  // Whether the places of a row's points within their columns differ.
  std::vector<std::uint32_t> places;
  for (const Vec2 p : points) {
    if (p.y < 0.125f) places.push_back(static_cast<std::uint32_t>(p.x * 64) % 8);
  }
  CHECK(*std::max_element(places.begin(), places.end()) !=
        *std::min_element(places.begin(), places.end()));
}

TEST_CASE("strata: each set and each dimension is jittered and ordered anew") {
  const auto sampler = prepared<StratifiedSampler>(16);
  const auto first = test::points_of(*sampler, {}, kDimension, 16);
  const auto next = test::points_of(*sampler, {}, kDimension, 16, 16);
  const auto other = test::points_of(*sampler, {}, {Purpose::pixel}, 16);
  for (std::size_t i = 0; i < 16; ++i) {
    CHECK_FALSE(first[i] == next[i]);
    CHECK_FALSE(first[i] == other[i]);
  }
}

TEST_CASE("strata: the stated size of a set is the size of passes") {
  CHECK(StratifiedSampler({.samples = 37}).preferred_samples() == 42);
  CHECK(MultiJitteredSampler({.samples = 16}).preferred_samples() == 16);
  CHECK(StratifiedSampler().preferred_samples() == 1);
  CHECK(set_size({}, {.samples_per_pixel = 0}) == 16);
  CHECK(set_size({}, {.samples_per_pixel = 100'000}) == SetPlace::kMostSamples);
  CHECK(set_size(9, {.samples_per_pixel = 100}) == 9);
}

}  // namespace pharos

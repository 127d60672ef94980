// Samplers over grids of strata, and their parts.
#include "../strata.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "../multi_jittered.h"
#include "../stratified.h"
#include "point_lists.h"

namespace pharos {
namespace {

constexpr Dimension kDimension{Purpose::lens};

/// Prepares a sampler of type S with sets of `samples`.
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
    // If quotients by reciprocals were wrong anywhere, the end of a row would be wrong first.
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

TEST_CASE("multi_jittered: numbers that are no products leave no interval of y out") {
  for (const std::uint32_t samples : {7u, 37u, 1021u}) {
    const auto sampler = prepared<MultiJitteredSampler>(samples);
    const StrataGrid grid = grid_of(samples);
    for (const std::uint32_t set : {0u, 3u}) {
      const auto points = test::points_of(*sampler, {}, kDimension, samples, set * samples);
      CHECK(test::fills_grid(points, 1, samples));
      std::vector<int> in_x(grid.cells()), in_cells(grid.cells());
      for (const Vec2 p : points) {
        const double column = std::floor(double{p.x} * grid.columns);
        const double row = std::floor(std::floor(double{p.y} * samples) / grid.columns);
        ++in_x[static_cast<std::size_t>(double{p.x} * grid.cells())];
        ++in_cells[static_cast<std::size_t>(row * grid.columns + column)];
      }
      CHECK(*std::max_element(in_x.begin(), in_x.end()) == 1);
      CHECK(*std::max_element(in_cells.begin(), in_cells.end()) == 1);
    }
    CHECK(test::fills_grid(test::numbers_of(*sampler, {}, kDimension, samples), samples, 1));
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
  // The places of a row's points within their columns must differ.
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

TEST_CASE("strata: with a time budget passes are sets of the default size, else as good as any") {
  CHECK(StratifiedSampler().preferred_samples({}) == kDefaultSetSize);
  CHECK(MultiJitteredSampler().preferred_samples({}) == kDefaultSetSize);
  CHECK(StratifiedSampler().preferred_samples({.samples_per_pixel = 100}) == 1);
  CHECK(MultiJitteredSampler().preferred_samples({.samples_per_pixel = 100}) == 1);
  // Passes of that size are whole sets.
  const auto timed = MultiJitteredSampler().prepare({}, {}, nullptr);
  CHECK(test::fills_grid(test::points_of(*timed, {}, kDimension, kDefaultSetSize, 16), 4, 4));
}

TEST_CASE("strata: the stated size of a set is the size of passes") {
  for (const SamplePlan& plan : {SamplePlan{}, SamplePlan{.samples_per_pixel = 100}}) {
    CHECK(StratifiedSampler({.samples = 37}).preferred_samples(plan) == 42);
    CHECK(MultiJitteredSampler({.samples = 37}).preferred_samples(plan) == 37);
  }
  CHECK(set_size({}, {.samples_per_pixel = 0}) == 16);
  CHECK(set_size({}, {.samples_per_pixel = 100'000}) == SetPlace::kMostSamples);
  CHECK(set_size(9, {.samples_per_pixel = 100}) == 9);
}

}  // namespace pharos

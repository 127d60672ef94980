#include "../z_sobol.h"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/point_sets.h>

#include "../sobol.h"
#include "../z_order.h"
#include "point_lists.h"

namespace pharos {
namespace {

constexpr int kWidth = 100;
constexpr Dimension kDimension{Purpose::light_position, 1};

std::unique_ptr<const PreparedSampler> prepared(std::uint32_t samples) {
  return ZSobolSampler().prepare({kWidth, 80}, {.samples_per_pixel = samples}, nullptr);
}

/// Returns all samples of a block of pixels.
std::vector<Vec2> block_points(const PreparedSampler& sampler, std::uint64_t x0, std::uint64_t y0,
                               std::uint64_t columns, std::uint64_t rows, std::uint32_t samples) {
  std::vector<Vec2> all;
  for (std::uint64_t y = y0; y < y0 + rows; ++y) {
    for (std::uint64_t x = x0; x < x0 + columns; ++x) {
      const auto points = test::points_of(sampler, {.index = y * kWidth + x}, kDimension, samples);
      all.insert(all.end(), points.begin(), points.end());
    }
  }
  return all;
}

/// Returns the mean of x y over the samples of a pixel, minus the integral.
double pixel_error(const PreparedSampler& sampler, std::uint64_t x, std::uint64_t y) {
  double sum = 0;
  for (const Vec2 u : block_points(sampler, x, y, 1, 1, 4)) sum += double{u.x} * u.y / 4;
  return sum - 0.25;
}

/// Returns the mean squared error of single pixels, divided by the mean squared error of averages
/// over 4 by 4 pixels.
double gain_by_blocks(const PreparedSampler& sampler) {
  double single = 0, blocks = 0;
  constexpr int kEdge = 64;
  for (std::uint64_t y = 0; y < kEdge; y += 4) {
    for (std::uint64_t x = 0; x < kEdge; x += 4) {
      double mean = 0;
      for (std::uint64_t i = 0; i < 16; ++i) {
        const double error = pixel_error(sampler, x + i % 4, y + i / 4);
        single += error * error;
        mean += error / 16;
      }
      blocks += mean * mean;
    }
  }
  return single / 16 / blocks;
}

}  // namespace

TEST_CASE("z_sobol: the samples of a pixel fill every elementary interval at each power of two") {
  for (const std::uint32_t samples : {1u, 2u, 16u, 512u, 4096u}) {
    const auto sampler = prepared(samples);
    for (const std::uint64_t pixel : {0u, 4711u}) {
      const auto points = test::points_of(*sampler, {.index = pixel}, kDimension, samples);
      for (std::size_t count = 1; count <= samples; count *= 2) {
        CHECK(statistics::fills_elementary_intervals(std::span(points).first(count)));
      }
      CHECK(test::fills_grid(test::numbers_of(*sampler, {.index = pixel}, kDimension, samples),
                             samples, 1));
    }
  }
}

TEST_CASE("z_sobol: so do those of aligned squares of pixels") {
  for (const std::uint32_t samples : {1u, 2u, 8u, 16u}) {
    CAPTURE(samples);
    const auto sampler = prepared(samples);
    for (std::uint64_t edge = 1; edge * edge * samples <= 4096 && edge <= 16; edge *= 2) {
      for (const std::uint64_t place : {0u, 1u, 3u}) {
        const auto points = block_points(*sampler, place * edge, 2 * edge, edge, edge, samples);
        CHECK(statistics::fills_elementary_intervals(points));
      }
    }
  }
}

TEST_CASE("z_sobol: pairs are rows or columns for a quarter each, else they lie crosswise") {
  const auto sampler = prepared(1);
  const auto point = [&](std::uint64_t x, std::uint64_t y) {
    return test::points_of(*sampler, {.index = y * kWidth + x}, kDimension, 1)[0];
  };
  // Two pixels of a quad form a net together if they are a pair.
  const auto share = [&](std::uint64_t right, std::uint64_t down) {
    double nets = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const std::uint64_t x = 2 * (i % 40), y = 2 * (i / 40);
      const std::vector<Vec2> points{point(x, y), point(x + right, y + down)};
      nets += statistics::fills_elementary_intervals(points) ? 1 : 0;
    }
    return nets / 1000;
  };
  // The standard deviations are 0.014 and 0.016.
  CHECK(std::abs(share(1, 0) - 0.25) < 0.07);
  CHECK(std::abs(share(0, 1) - 0.25) < 0.07);
  CHECK(std::abs(share(1, 1) - 0.5) < 0.07);
}

TEST_CASE("z_sobol: every level of the z-order has each pairing, over nodes as over dimensions") {
  // A child's pair is determined by y, by x or by their sum. The images of the children show which.
  const auto shares = [](int level, bool over_nodes) {
    std::array<double, 3> counts{};
    RandomStream random(1);
    constexpr int kDraws = 2000;
    for (int i = 0; i < kDraws; ++i) {
      const std::uint64_t dimension = over_nodes ? 3 : random();
      const Seeds seeds = seeds_of(dimension, {Purpose::lens});
      const std::uint32_t before =
          static_cast<std::uint32_t>(random()) & ((1u << (2 * level)) - 1u);
      const auto pair = [&](std::uint32_t child) {
        const std::uint32_t reversed = before | (child << (2 * level));
        return (z_order::with_pairings(reversed, seeds, 0x55555555u) >> (2 * level)) & 1;
      };
      const bool by_first = pair(1) != pair(0), by_second = pair(2) != pair(0);
      ++counts[by_first && by_second ? 2 : by_second ? 1 : 0];
    }
    for (double& n : counts) n /= kDraws;
    return counts;
  };
  for (int level = 0; level < 16; ++level) {
    CAPTURE(level);
    for (const bool over_nodes : {false, true}) {
      // The first levels have only few nodes.
      if (over_nodes && level < 6) continue;
      const auto [rows, columns, crosswise] = shares(level, over_nodes);
      CHECK(std::abs(rows - 0.25) < 0.07);
      CHECK(std::abs(columns - 0.25) < 0.07);
      CHECK(std::abs(crosswise - 0.5) < 0.07);
    }
  }
}

TEST_CASE("z_sobol: errors of neighbors cancel") {
  const double apart = gain_by_blocks(*SobolSampler().prepare({kWidth, 80}, {}, nullptr));
  CHECK(apart == doctest::Approx(16).epsilon(0.3));
  CHECK(gain_by_blocks(*prepared(4)) > 5 * apart);
}

TEST_CASE("z_sobol: sets follow each other where the number of samples is unknown") {
  const auto sampler = prepared(0);
  const auto first = test::points_of(*sampler, {.index = 7}, kDimension, 16);
  const auto next = test::points_of(*sampler, {.index = 7}, kDimension, 16, 16);
  CHECK(statistics::fills_elementary_intervals(next));
  for (std::size_t i = 0; i < 16; ++i) CHECK_FALSE(first[i] == next[i]);
  CHECK(ZSobolSampler({.samples = 9}).preferred_samples({}) == 16);
  CHECK(ZSobolSampler().preferred_samples({}) == 16);
  CHECK(ZSobolSampler().preferred_samples({.samples_per_pixel = 64}) == 1);
}

TEST_CASE("z_sobol: pixels far apart in large images are unrelated") {
  // 2^20 pixels of 2^12 samples use up the 32 bits of a place. The far pixel has z-order index
  // 2^21.
  const auto sampler = prepared(4096);
  const auto near = test::points_of(*sampler, {.index = 0}, kDimension, 64);
  const auto far = test::points_of(*sampler, {.index = 1024 * kWidth}, kDimension, 64);
  for (std::size_t i = 0; i < near.size(); ++i) CHECK_FALSE(near[i] == far[i]);
}

}  // namespace pharos

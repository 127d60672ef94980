// Permutations of strata, the seeds that select them, and the seeds that draw their tables.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>

#include "../halton.h"
#include "../keyed_seeds.h"
#include "../multi_jittered.h"
#include "../strata.h"
#include "../stratified.h"
#include "point_lists.h"

namespace pharos {
namespace {

std::vector<std::uint32_t> images_of(const DrawnPermutations& permutations, std::uint32_t count,
                                     std::uint32_t seed) {
  std::vector<std::uint32_t> images(count);
  for (std::uint32_t i = 0; i < count; ++i) images[i] = permutations(i, seed);
  return images;
}

/// Adds the p-value of counts that should be equal. Counts that differ too much and counts that
/// agree too closely are both errors.
void add_both_tails(const std::vector<double>& counts, double each, std::vector<double>& p_values) {
  const std::vector<double> expected(counts.size(), each);
  const double p = statistics::chi_square_test(counts, expected).p_value;
  p_values.push_back(std::min(1.0, 2 * std::min(p, 1 - p)));
}

/// Tests of seeds use 2^14 states. The number of agreements of two bits is then binomial with a
/// standard deviation of 64.
constexpr std::uint32_t kSeedDraws = 1u << 14;
constexpr int kSeedLimit = 6 * 64;

template <std::size_t N>
std::uint64_t bit(const std::array<std::uint64_t, N>& words, std::size_t place) {
  return (words[place / 64] >> (place % 64)) & 1;
}

/// Returns how far the number of agreements of any two bits is from half of the draws.
template <std::size_t N>
int furthest_from_half(const std::vector<std::array<std::uint64_t, N>>& all) {
  int furthest = 0;
  for (std::size_t a = 0; a < 64 * N; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      int agree = 0;
      for (const auto& words : all) agree += bit(words, a) == bit(words, b) ? 1 : 0;
      furthest = std::max(furthest, std::abs(agree - static_cast<int>(kSeedDraws / 2)));
    }
  }
  return furthest;
}

}  // namespace

TEST_CASE("permutations: all are bijections") {
  for (std::uint32_t count = 1; count <= 300; ++count) {
    const DrawnPermutations permutations(count, 1);
    std::vector<std::uint32_t> images = images_of(permutations, count, 0x12345679u * count);
    std::sort(images.begin(), images.end());
    bool whole = true;
    for (std::uint32_t i = 0; i < count; ++i) whole &= images[i] == i;
    CHECK(whole);
  }
}

TEST_CASE("permutations: every image, and every difference of two images, is as likely") {
  constexpr double kEach = 200;
  for (const std::uint32_t count : {16u, 37u, 64u}) {
    const DrawnPermutations permutations(count, 1);
    // The differences of the images of every pair of indices, modulo the count, and the images of
    // each index.
    std::vector<std::vector<double>> differences(count * count, std::vector<double>(count - 1));
    std::vector<std::vector<double>> images(count, std::vector<double>(count));
    RandomStream random(count);
    const auto draws = static_cast<int>(kEach * (count - 1));
    for (int draw = 0; draw < draws; ++draw) {
      const auto seed = static_cast<std::uint32_t>(random());
      const std::vector<std::uint32_t> drawn = images_of(permutations, count, seed);
      for (std::uint32_t i = 0; i < count; ++i) {
        ++images[i][drawn[i]];
        for (std::uint32_t j = 0; j < i; ++j) {
          ++differences[i * count + j][(drawn[i] + count - drawn[j]) % count - 1];
        }
      }
    }
    std::vector<double> p_values;
    for (std::uint32_t i = 0; i < count; ++i) {
      add_both_tails(images[i], draws / static_cast<double>(count), p_values);
      for (std::uint32_t j = 0; j < i; ++j) {
        add_both_tails(differences[i * count + j], kEach, p_values);
      }
    }
    CAPTURE(count);
    double least = 1;
    for (const double p : statistics::holm_adjusted(p_values)) least = std::min(least, p);
    CHECK(least > 0.01);
  }
}

TEST_CASE("permutations: all pairs of images of two indices are as likely") {
  std::vector<double> p_values;
  for (const std::uint32_t count : {2u, 4u, 7u, 16u, 64u}) {
    const DrawnPermutations permutations(count, 1);
    RandomStream random(count);
    std::vector<double> pairs(count * (count - 1));
    for (std::size_t i = 0; i < 200 * pairs.size(); ++i) {
      const auto seed = static_cast<std::uint32_t>(random());
      const std::uint32_t a = permutations(0, seed), b = permutations(count - 1, seed);
      ++pairs[a * (count - 1) + b - (b > a ? 1 : 0)];
    }
    add_both_tails(pairs, 200, p_values);
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("permutations: through one table all images are as likely, differences nearly so") {
  for (const std::uint32_t count : {4u, 7u, 8u, 16u}) {
    CAPTURE(count);
    const DrawnPermutations permutations(count, 1);
    RandomStream random(count);
    constexpr std::uint32_t kEach = 4000;
    std::vector<double> images(count), differences(count - 1);
    for (std::uint32_t draw = 0; draw < kEach * count; ++draw) {
      const auto seed = static_cast<std::uint32_t>(random());
      std::vector<std::uint32_t> drawn(count);
      for (std::uint32_t i = 0; i < count; ++i) drawn[i] = permutations.through_one(i, seed);
      ++images[drawn[1]];
      ++differences[(drawn[1] + count - drawn[0]) % count - 1];
      std::sort(drawn.begin(), drawn.end());
      REQUIRE(std::adjacent_find(drawn.begin(), drawn.end()) == drawn.end());
    }
    std::vector<double> p_values;
    add_both_tails(images, kEach, p_values);
    CHECK(p_values[0] > 0.001);
    const double even = kEach * count / (count - 1.0);
    for (const double n : differences) CHECK(std::abs(n / even - 1) < 0.3);
  }
}

TEST_CASE("permutations: large counts have every image, and many permutations") {
  constexpr std::uint32_t kCount = 1u << 16;
  const DrawnPermutations permutations(kCount, 1);
  std::vector<bool> hit(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) hit[permutations(i, 77)] = true;
  CHECK(std::find(hit.begin(), hit.end(), false) == hit.end());
  // Nearly all differences of two images are different: 1000 draws of 65,535.
  std::vector<std::uint32_t> differences;
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto seed = static_cast<std::uint32_t>(random());
    differences.push_back((permutations(1, seed) - permutations(0, seed)) % kCount);
  }
  std::sort(differences.begin(), differences.end());
  const auto last = std::unique(differences.begin(), differences.end());
  CHECK(last - differences.begin() > 970);
}

TEST_CASE("permutations: the seed of the plan draws them") {
  // The keys of the paths are equal, so only the plan's seed can change the points. It draws the
  // permutations of digits and of cells.
  const auto points = [](const Sampler& sampler, std::uint64_t seed) {
    const auto prepared = sampler.prepare({}, {.seed = seed, .samples_per_pixel = 64}, nullptr);
    return test::points_of(*prepared, {}, {Purpose::lens}, 64);
  };
  CHECK(points(HaltonSampler(), 1) == points(HaltonSampler(), 1));
  CHECK_FALSE(points(HaltonSampler(), 1) == points(HaltonSampler(), 2));
  CHECK_FALSE(points(StratifiedSampler(), 1) == points(StratifiedSampler(), 2));
  CHECK_FALSE(points(MultiJitteredSampler(), 1) == points(MultiJitteredSampler(), 2));
}

TEST_CASE("seeds: numbers with the order of another dimension have unrelated scrambles") {
  constexpr Dimension kOrder{Purpose::bsdf_direction, 2};
  std::vector<std::array<std::uint64_t, 3>> all;
  RandomStream random(2);
  for (std::uint32_t i = 0; i < kSeedDraws; ++i) {
    const std::uint64_t state = random();
    const Seeds first = seeds_of(state, kOrder), second = seeds_of(state, kOrder, 6),
                third = seeds_of(state, kOrder, 8);
    CHECK(second.order == first.order);
    const auto scrambles = [](const Seeds& s) { return (std::uint64_t{s.x} << 32) | s.y; };
    all.push_back({scrambles(first), scrambles(second), scrambles(third)});
  }
  CHECK(furthest_from_half(all) < kSeedLimit);
}

TEST_CASE("seeds: no two bits of the four words are related, nor are four") {
  std::vector<std::array<std::uint64_t, 2>> all;
  RandomStream random(1);
  for (std::uint32_t i = 0; i < kSeedDraws; ++i) {
    const Seeds s = seeds_of(random(), {Purpose::light_position, 2});
    all.push_back({(std::uint64_t{s.order} << 32) | s.x, (std::uint64_t{s.y} << 32) | s.more});
  }
  CHECK(furthest_from_half(all) < kSeedLimit);
  // The sums of the bits of the four words at the same place.
  for (std::size_t place = 0; place < 32; ++place) {
    int odd = 0;
    for (const auto& w : all) {
      odd += static_cast<int>(bit(w, place) ^ bit(w, place + 32) ^ bit(w, place + 64) ^
                              bit(w, place + 96));
    }
    CHECK(std::abs(odd - static_cast<int>(kSeedDraws / 2)) < kSeedLimit);
  }
}

}  // namespace pharos

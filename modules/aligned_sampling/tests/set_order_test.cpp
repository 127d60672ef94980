#include "../set_order.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

namespace pharos::aligned {
namespace {

constexpr int kBits = 6;
constexpr std::uint32_t kCount = 1u << kBits;

std::vector<GridPoint> random_points(std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<GridPoint> points(kCount);
  for (GridPoint& p : points) {
    const std::uint64_t bits = random();
    p = {static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(bits >> 16)};
  }
  return points;
}

}  // namespace

TEST_CASE("set order: points are sorted into the cells of a kd-tree") {
  std::vector<GridPoint> points = random_points(1), sorted = points;
  sort_into_cells(sorted);
  const auto highest = [&](std::size_t first, std::size_t count, auto coordinate) {
    return std::ranges::max(std::span(sorted).subspan(first, count), {}, coordinate);
  };
  const auto lowest = [&](std::size_t first, std::size_t count, auto coordinate) {
    return std::ranges::min(std::span(sorted).subspan(first, count), {}, coordinate);
  };
  CHECK(highest(0, 32, &GridPoint::x).x <= lowest(32, 32, &GridPoint::x).x);
  for (const std::size_t half : {0, 32}) {
    CHECK(highest(half, 16, &GridPoint::y).y <= lowest(half + 16, 16, &GridPoint::y).y);
  }
  const auto less = [](GridPoint a, GridPoint b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  std::ranges::sort(points, less);
  std::vector<GridPoint> again = sorted;
  std::ranges::sort(again, less);
  CHECK(again == points);
}

TEST_CASE("set order: bits in reverse") {
  CHECK(reversed_bits(1) == 0x80000000u);
  CHECK(reversed_bits(0x00012345u) == 0xa2c48000u);
  static_assert(reversed_bits(reversed_bits(0xdeadbeefu)) == 0xdeadbeefu);
}

TEST_CASE("set order: aligned runs of samples have a point in each cell") {
  for (const std::uint32_t seed : {0u, 1u, 0x12345678u, 0xffffffffu}) {
    CAPTURE(seed);
    for (int level = 0; level <= kBits; ++level) {
      const std::uint32_t run = 1u << level;
      for (std::uint32_t first = 0; first < 3 * kCount; first += run) {
        std::vector<int> counts(run);
        for (std::uint32_t i = first; i < first + run; ++i) {
          const std::uint32_t place = place_in_set(i, kBits, seed);
          REQUIRE(place < kCount);
          ++counts[place >> (kBits - level)];
        }
        CHECK(std::ranges::count(counts, 1) == static_cast<std::ptrdiff_t>(run));
      }
    }
  }
}

TEST_CASE("set order: orders of different seeds are unrelated") {
  // How often sample i is in half a of one order and in half b of another.
  int same = 0, count = 0;
  RandomStream random(2);
  for (int pair = 0; pair < 200; ++pair) {
    const auto one = static_cast<std::uint32_t>(random()),
               other = static_cast<std::uint32_t>(random());
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const std::uint32_t a = place_in_set(i, kBits, one), b = place_in_set(i, kBits, other);
      same += a >> (kBits - 1) == b >> (kBits - 1) ? 1 : 0;
      ++count;
    }
  }
  CHECK(same / static_cast<double>(count) == doctest::Approx(0.5).epsilon(0.04));
}

}  // namespace pharos::aligned

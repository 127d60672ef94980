#include "../set_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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

TEST_CASE("set order: points chosen by their numbers are evenly spread along the direction") {
  const std::vector<GridPoint> points = random_points(2);
  const std::vector<std::uint32_t> choices = spread_choices(points, 30);
  std::vector<std::size_t> ranked(kCount);
  std::iota(ranked.begin(), ranked.end(), std::size_t{0});
  std::ranges::sort(ranked, {}, [&](std::size_t i) {
    return std::cos(0.5235987756) * points[i].x + 0.5 * points[i].y;
  });
  for (const std::uint32_t chosen : {1u, 8u, 16u, 32u}) {
    const std::uint32_t step = kCount / chosen;
    for (std::uint32_t rank = 0; rank < kCount; ++rank) {
      const bool is_chosen = choices[ranked[rank]] < (chosen << (32 - kBits));
      CHECK(is_chosen == (rank % step == 0));
    }
  }
  std::vector<std::uint32_t> sorted = choices;
  std::ranges::sort(sorted);
  for (std::uint32_t i = 0; i < kCount; ++i) CHECK(sorted[i] == i << (32 - kBits));
}

TEST_CASE("set order: aligned runs of samples have a point in each cell") {
  const SetOrders orders(kBits);
  for (const std::uint32_t seed : {0u, 1u, 0x12345678u, 0xffffffffu}) {
    CAPTURE(seed);
    for (int level = 0; level <= kBits; ++level) {
      const std::uint32_t run = 1u << level;
      for (std::uint32_t first = 0; first < 3 * kCount; first += run) {
        std::vector<int> counts(run);
        for (std::uint32_t i = first; i < first + run; ++i) {
          const std::uint32_t place = orders.place(i, seed);
          REQUIRE(place < kCount);
          ++counts[place >> (kBits - level)];
        }
        CHECK(std::ranges::count(counts, 1) == static_cast<std::ptrdiff_t>(run));
      }
    }
  }
}

TEST_CASE("set order: orders of different seeds are unrelated") {
  // Counts how often sample i lies in the same half in two orders.
  const SetOrders orders(kBits);
  int same = 0, count = 0;
  RandomStream random(2);
  for (int pair = 0; pair < 200; ++pair) {
    const auto one = static_cast<std::uint32_t>(random()),
               other = static_cast<std::uint32_t>(random());
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const std::uint32_t a = orders.place(i, one), b = orders.place(i, other);
      same += a >> (kBits - 1) == b >> (kBits - 1) ? 1 : 0;
      ++count;
    }
  }
  CHECK(same / static_cast<double>(count) == doctest::Approx(0.5).epsilon(0.04));
}

TEST_CASE("set order: of the largest sets too") {
  const SetOrders orders(16);
  std::vector<int> counts(65536);
  for (std::uint32_t i = 65536; i < 2 * 65536; ++i) ++counts[orders.place(i, 12345)];
  CHECK(std::ranges::count(counts, 1) == 65536);
}

}  // namespace pharos::aligned

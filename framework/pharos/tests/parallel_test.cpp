#include <atomic>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/parallel.h>
#include <pharos/core/random.h>

using namespace pharos;

namespace {

/// Returns a sum whose rounding depends on the order of its terms.
float ordered_sum(std::size_t count) {
  float sum = 0;
  parallel_ordered(
      count, [](std::size_t i) { return RandomStream(9, i).next_1d() - 0.5f; },
      [&](std::size_t, float v) { sum += v; });
  return sum;
}

}  // namespace

TEST_CASE("results are consumed in order, each once") {
  std::vector<std::size_t> seen;
  parallel_ordered(
      1000, [](std::size_t i) { return i * i; },
      [&](std::size_t i, std::size_t square) {
        seen.push_back(i);
        if (square != i * i) seen.push_back(~std::size_t{0});
      });
  REQUIRE(seen.size() == 1000);
  for (std::size_t i = 0; i < 1000; ++i) CHECK(seen[i] == i);
}

TEST_CASE("a fold is the same in every bit for any number of threads") {
  float sums[3];
  for (int threads = 1; threads <= 3; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    sums[threads - 1] = ordered_sum(5000);
  }
  float serial = 0;
  for (std::size_t i = 0; i < 5000; ++i) serial += RandomStream(9, i).next_1d() - 0.5f;
  for (const float sum : sums) CHECK(sum == serial);
}

TEST_CASE("the loop ends early, and all before the end is consumed") {
  std::size_t consumed = 0, last = 0;
  parallel_ordered(
      100, [](std::size_t i) { return i; },
      [&](std::size_t i, std::size_t) {
        ++consumed;
        last = i;
      },
      [](std::size_t i) { return i < 37; });
  CHECK(consumed == 37);
  CHECK(last == 36);
}

TEST_CASE("nothing to do") {
  bool touched = false;
  parallel_ordered(
      0, [](std::size_t) { return 0; }, [&](std::size_t, int) { touched = true; });
  CHECK_FALSE(touched);
}

TEST_CASE("errors of the work reach the caller") {
  const auto run = [] {
    parallel_ordered(
        100,
        [](std::size_t i) {
          if (i == 20) throw std::runtime_error("lost");
          return i;
        },
        [](std::size_t, std::size_t) {});
  };
  CHECK_THROWS_WITH_AS(run(), "lost", std::runtime_error);
}

TEST_CASE("parallel_for visits every index once") {
  std::vector<std::atomic<int>> visits(1000);
  parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const auto& v : visits) CHECK(v == 1);
}

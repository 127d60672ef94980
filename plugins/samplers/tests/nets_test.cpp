// Samplers whose prefixes are (0,2)-nets (sobol, pmj02, pmj02bn), and the differences between them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/point_sets.h>

#include "../blue_noise.h"
#include "../independent.h"
#include "../pmj02.h"
#include "../pmj02_tables.h"
#include "../pmj02bn.h"
#include "../sobol.h"
#include "point_lists.h"

namespace pharos {
namespace {

constexpr SamplePlan kPlan{.seed = 3, .samples_per_pixel = 4096};
constexpr Dimension kDimension{Purpose::light_position, 2, 5};

struct Subject {
  std::string name;
  std::unique_ptr<const PreparedSampler> sampler;
};

std::vector<Subject> net_samplers() {
  std::vector<Subject> all;
  all.push_back({"sobol", SobolSampler().prepare({}, kPlan, nullptr)});
  all.push_back({"pmj02", Pmj02Sampler().prepare({}, kPlan, nullptr)});
  all.push_back({"pmj02bn", Pmj02bnSampler().prepare({}, kPlan, nullptr)});
  return all;
}

std::vector<Vec2> numbers(const std::vector<pmj02::Point>& points, std::size_t first,
                          std::size_t count) {
  std::vector<Vec2> all;
  for (std::size_t i = first; i < first + count; ++i) {
    all.push_back({to_unit_float(points[i].x), to_unit_float(points[i].y)});
  }
  return all;
}

/// Returns the mean distance of a point to its nearest neighbor on the torus, in units of n^-1/2.
double mean_distance(const std::vector<Vec2>& points) {
  double sum = 0;
  for (const Vec2& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec2& q : points) {
      if (&p == &q) continue;
      const double x = std::remainder(double{p.x} - q.x, 1.0);
      const double y = std::remainder(double{p.y} - q.y, 1.0);
      nearest = std::min(nearest, std::hypot(x, y));
    }
    sum += nearest;
  }
  return sum / std::sqrt(static_cast<double>(points.size()));
}

double mean_distance(const PreparedSampler& sampler, std::uint32_t count) {
  constexpr std::uint64_t kPixels = 100;
  double sum = 0;
  for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
    sum += mean_distance(test::points_of(sampler, {.index = pixel}, kDimension, count));
  }
  return sum / kPixels;
}

}  // namespace

TEST_CASE("nets: the first 2^k samples fill every elementary interval") {
  for (const Subject& s : net_samplers()) {
    CAPTURE(s.name);
    for (std::uint64_t pixel = 0; pixel < 5; ++pixel) {
      const auto points = test::points_of(*s.sampler, {.index = pixel}, kDimension, 4096);
      for (std::size_t count = 1; count <= 4096; count *= 2) {
        CHECK(statistics::fills_elementary_intervals(std::span(points).first(count)));
        // Later blocks are nets as well: the sequences are (0,2)-sequences.
        CHECK(statistics::fills_elementary_intervals(std::span(points).last(count)));
      }
    }
  }
}

TEST_CASE("nets: numbers in 1D are stratified at every power of two") {
  for (const Subject& s : net_samplers()) {
    CAPTURE(s.name);
    for (std::size_t count = 1; count <= 4096; count *= 2) {
      const auto numbers = test::numbers_of(*s.sampler, {.index = 4}, {Purpose::bsdf_choice, 1},
                                            static_cast<std::uint32_t>(count));
      CHECK(test::fills_grid(numbers, count, 1));
    }
  }
}

TEST_CASE("nets: the star discrepancy keeps below the bound for (0,m,2)-nets") {
  // n D* <= m / 2 + 3 / 2 for n = 2^m (Niederreiter 1992, "Random Number Generation and Quasi-Monte
  // Carlo Methods", theorem 4.7 with base 2).
  const auto excess = [](const PreparedSampler& sampler, int m) {
    const std::uint32_t count = 1u << m;
    const auto points = test::points_of(sampler, {.index = 8}, kDimension, count);
    return statistics::star_discrepancy(points) * count - (0.5 * m + 1.5);
  };
  for (const Subject& s : net_samplers()) {
    CAPTURE(s.name);
    for (int m = 2; m <= 10; ++m) CHECK(excess(*s.sampler, m) <= 0);
  }
  CHECK(excess(*IndependentSampler().prepare({}, kPlan, nullptr), 10) > 0);
}

TEST_CASE("pmj02: sets beyond the tables begin anew") {
  for (const Subject& s : net_samplers()) {
    CAPTURE(s.name);
    const auto first = test::points_of(*s.sampler, {}, kDimension, 256);
    const auto later = test::points_of(*s.sampler, {}, kDimension, 256, 3 * 4096);
    CHECK(statistics::fills_elementary_intervals(later));
    CHECK_FALSE(std::is_permutation(first.begin(), first.end(), later.begin()));
  }
}

TEST_CASE("pmj02: sequences of a seed have the same beginning, whatever their length") {
  const auto whole = pmj02::sequence(10, 5), part = pmj02::sequence(6, 5);
  for (std::size_t i = 0; i < part.size(); ++i) {
    CHECK(part[i].x == whole[i].x);
    CHECK(part[i].y == whole[i].y);
  }
  for (std::size_t size = 1; size <= whole.size(); size *= 2) {
    for (std::size_t first = 0; first < whole.size(); first += size) {
      REQUIRE(statistics::fills_elementary_intervals(numbers(whole, first, size)));
    }
  }
}

TEST_CASE("pmj02: tables are as long as the plan asks for") {
  CHECK(pmj02::table_bits({.samples_per_pixel = 0}) == 12);
  CHECK(pmj02::table_bits({.samples_per_pixel = 1}) == 8);
  CHECK(pmj02::table_bits({.samples_per_pixel = 256}) == 8);
  CHECK(pmj02::table_bits({.samples_per_pixel = 257}) == 9);
  CHECK(pmj02::table_bits({.samples_per_pixel = 4'000'000'000u}) == 16);
}

TEST_CASE("pmj02bn: points moved apart stay a (0,2)-sequence") {
  auto points = pmj02::sequence(8, 1);
  const double before = mean_distance(numbers(points, 0, 256));
  pmj02::move_apart(points, 1);
  CHECK(mean_distance(numbers(points, 0, 256)) > 1.05 * before);
  pmj02::double_sequence(points, 1);
  for (std::size_t size = 1; size <= points.size(); size *= 2) {
    for (std::size_t first = 0; first < points.size(); first += size) {
      REQUIRE(statistics::fills_elementary_intervals(numbers(points, first, size)));
    }
  }
}

TEST_CASE("pmj02bn: points lie farther apart than those of pmj02") {
  const auto plain = Pmj02Sampler().prepare({}, kPlan, nullptr);
  const auto apart = Pmj02bnSampler().prepare({}, kPlan, nullptr);
  for (const std::uint32_t count : {16u, 64u, 256u}) {
    CAPTURE(count);
    CHECK(mean_distance(*apart, count) > 1.04 * mean_distance(*plain, count));
  }
}

TEST_CASE("samplers: any number of samples is as good") {
  CHECK(IndependentSampler().preferred_samples({}) == 1);
  CHECK(SobolSampler().preferred_samples({}) == 1);
  CHECK_FALSE(SobolSampler().needs_probe());
}

}  // namespace pharos

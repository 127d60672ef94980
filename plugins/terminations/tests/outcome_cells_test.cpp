#include "../outcome_cells.h"

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// Steps on both sides of the plane x = 0, which find 1 on the left and 3 on the right if the
/// viewer is above, and nothing otherwise.
OutcomeCells two_sides(const DirectionBins& bins, std::size_t count) {
  std::vector<Outcome> steps;
  RandomStream random(1);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = 2 * random.next_1d() - 1;
    const Vec3 viewer = warp::sphere_from_square({random.next_1d(), random.next_1d()});
    const float radiance = viewer.z > 0 ? (x < 0 ? 1.0f : 3.0f) : 0.0f;
    steps.push_back({{x, 0.01f * x, 0}, viewer, radiance, radiance, x < 0 ? 2.0f : 5.0f});
  }
  OutcomeCells cells;
  cells.learn(
      steps, {.cell_samples = static_cast<std::uint32_t>(3 * count / 4)},
      [&](OutcomeCell& cell, std::span<const Outcome> own, std::size_t) { cell.learn(own, bins); });
  return cells;
}

}  // namespace

TEST_CASE("outcome cells: every direction has a bin, and bins have equal solid angles") {
  const DirectionBins bins(4);
  REQUIRE(bins.count() == 16);
  std::vector<int> hits(bins.count());
  RandomStream random(2);
  for (int i = 0; i < 64'000; ++i) {
    const Vec3 d = warp::sphere_from_square({random.next_1d(), random.next_1d()});
    ++hits.at(bins.at(d));
  }
  for (const int n : hits) CHECK(std::abs(n - 4000) < 400);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      Vec3 d;
      d[axis] = sign;
      CHECK(bins.at(d) < bins.count());
    }
  }
}

TEST_CASE("outcome cells: expected values by position and direction") {
  const DirectionBins bins(2);
  const OutcomeCells cells = two_sides(bins, 4000);
  CHECK(cells.size() == 2);
  const OutcomeField field(cells, bins, 1);
  const ExpectedOutcome left = field.at({-0.9f, 0, 0}, {0.1f, 0.1f, 0.99f});
  const ExpectedOutcome right = field.at({0.9f, 0, 0}, {0.1f, 0.1f, 0.99f});
  CHECK(left.radiance == doctest::Approx(1).epsilon(0.03));
  CHECK(right.radiance == doctest::Approx(3).epsilon(0.03));
  CHECK(left.step.squared == doctest::Approx(std::sqrt(1 / 2.0)).epsilon(0.03));
  CHECK(right.step.squared == doctest::Approx(std::sqrt(9 / 5.0)).epsilon(0.03));
  CHECK(right.step.variance < 0.15f);
  CHECK(field.at({0.9f, 0, 0}, {0, 0, -1}).radiance < 0.1f);
}

TEST_CASE("outcome cells: the same bin of the larger cell counts as a number of steps") {
  const DirectionBins bins(2);
  // Each bin has about 1000 steps, half of them on each side. The mean of the scene is 1.
  const OutcomeCells cells = two_sides(bins, 4000);
  const double upper = (1000 * 2 + 400 * 1) / 1400.0, left = (500 * 1 + 400 * upper) / 900;
  const OutcomeField field(cells, bins, 400);
  CHECK(field.at({-0.9f, 0, 0}, {0.1f, 0.1f, 0.99f}).radiance ==
        doctest::Approx(left).epsilon(0.05));
  CHECK(field.at({-0.9f, 0, 0}, {0.1f, 0.1f, -0.99f}).radiance > 0.1f);
  // No cell below the whole scene has enough steps.
  const OutcomeField coarse(cells, bins, 800);
  for (const float x : {-0.9f, 0.9f}) {
    CHECK(coarse.at({x, 0, 0}, {0.1f, 0.1f, 0.99f}).radiance ==
          doctest::Approx((1000 * 2 + 800) / 1800.0).epsilon(0.05));
  }
}

TEST_CASE("outcome cells: limits of estimates change the variance, but not the second moment") {
  const DirectionBins bins(1);
  OutcomeCells cells;
  std::vector<Outcome> steps{{{}, {0, 0, 1}, 1, 1, 2}, {{}, {0, 0, 1}, 9, 3, 2}};
  cells.learn(steps, {}, [&](OutcomeCell& cell, std::span<const Outcome> own, std::size_t) {
    cell.learn(own, bins);
  });
  const ExpectedOutcome found = OutcomeField(cells, bins, 1).at({}, {0, 0, 1});
  CHECK(found.radiance == doctest::Approx(5));
  CHECK(found.step.squared == doctest::Approx(std::sqrt((1 + 81) / 2.0 / 2)));
  CHECK(found.step.variance == doctest::Approx(std::sqrt(1 / 2.0)));
}

TEST_CASE("outcome cells: light samples have expected values of their own") {
  const DirectionBins bins(1);
  OutcomeCells cells;
  std::vector<Outcome> outcomes{{{}, {0, 0, 1}, 1, 1, 8}, {{}, {0, 0, 1}, 3, 3, 8}};
  for (const float found : {0.0f, 0.0f, 6.0f}) {
    outcomes.push_back({{}, {0, 0, 1}, found, found, 2, 1, true});
  }
  cells.learn(outcomes, {}, [&](OutcomeCell& cell, std::span<const Outcome> own, std::size_t) {
    cell.learn(own, bins);
  });
  const ExpectedOutcome found = OutcomeField(cells, bins, 1).at({}, {0, 0, 1});
  CHECK(found.radiance == doctest::Approx(2 + 2));
  CHECK(found.step.squared == doctest::Approx(std::sqrt(5 / 8.0)));
  CHECK(found.step.variance == doctest::Approx(std::sqrt(1 / 8.0)));
  CHECK(found.light.squared == doctest::Approx(std::sqrt(12 / 2.0)));
  CHECK(found.light.variance == doctest::Approx(std::sqrt(8 / 2.0)));
}

TEST_CASE("outcome cells: an outcome counts for its number of steps") {
  const DirectionBins bins(1);
  OutcomeCells cells;
  std::vector<Outcome> steps{{{}, {0, 0, 1}, 1, 1, 2, 3}, {{}, {0, 0, 1}, 5, 5, 6, 1}};
  cells.learn(steps, {}, [&](OutcomeCell& cell, std::span<const Outcome> own, std::size_t) {
    cell.learn(own, bins);
  });
  const ExpectedOutcome found = OutcomeField(cells, bins, 4).at({}, {0, 0, 1});
  CHECK(found.radiance == doctest::Approx((3 * 1 + 5) / 4.0));
  const double squared = (3 * 1 + 25) / 4.0, cost = (3 * 2 + 6) / 4.0;
  CHECK(found.step.squared == doctest::Approx(std::sqrt(squared / cost)));
}

TEST_CASE("outcome cells: moments that no float can hold are the largest float") {
  const DirectionBins bins(1);
  OutcomeCells cells;
  std::vector<Outcome> steps(100, {{}, {0, 0, 1}, 1e30f, 1e30f, 2});
  cells.learn(steps, {}, [&](OutcomeCell& cell, std::span<const Outcome> own, std::size_t) {
    cell.learn(own, bins);
  });
  CHECK(std::isfinite(OutcomeField(cells, bins, 10).at({}, {0, 0, 1}).step.squared));
}

TEST_CASE("outcome cells: where no step was recorded, the mean of the scene counts") {
  const DirectionBins bins(2);
  OutcomeCells cells;
  std::vector<Outcome> steps(100, {{}, {0.1f, 0.1f, 0.99f}, 6, 6, 2});
  cells.learn(steps, {}, [&](OutcomeCell& cell, std::span<const Outcome> own, std::size_t) {
    cell.learn(own, bins);
  });
  CHECK(OutcomeField(cells, bins, 10).at({}, {0.1f, 0.1f, -0.99f}).radiance == 6);
}

}  // namespace pharos

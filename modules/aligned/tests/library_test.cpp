// Tests which set serves which directions, and tests the shipped sets.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "../point_set_library.h"
#include "../shipped_sets.h"
#include "../wasserstein_loss.h"

namespace pharos::aligned {
namespace {

using pharos::test::TemporaryFolder;

/// Returns the root mean square distance of projections along a direction from the centers of their
/// strata [mean width of a stratum].
double unevenness(const PointSet& set, double degrees) {
  Coordinates points(set.size()), unused(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    points.x[i] = static_cast<double>(set[i].position().x);
    points.y[i] = static_cast<double>(set[i].position().y);
  }
  const std::vector<Direction> one{direction_of(degrees)};
  return std::sqrt(WassersteinLoss(one, set.size()).evaluate(points, 1, unused));
}

}  // namespace

TEST_CASE("grid points: cells of 2^-16 and their middles") {
  CHECK(grid_point(0, 0) == GridPoint{0, 0});
  CHECK(grid_point(0.5, 1 - 0x1p-20) == GridPoint{0x8000, 0xffff});
  CHECK(grid_point(-0x1p-16, 1.25) == GridPoint{0xffff, 0x4000});
  CHECK(grid_point(-1e-300, 1) == GridPoint{0, 0});  // modulo one, this number rounds to one
  CHECK(GridPoint{0xffff, 0}.position().x == 1 - 0x1p-17f);
  CHECK(GridPoint{0xffff, 0}.position().y == 0x1p-17f);
}

TEST_CASE("symmetries: points and directions are turned alike, and back by the same") {
  for (const bool swaps : {false, true}) {
    for (const bool mirrors : {false, true}) {
      const Symmetry symmetry{swaps, mirrors};
      for (int degrees = 0; degrees < 180; ++degrees) {
        const int turned = symmetry(degrees);
        CHECK((turned >= 0 && turned < 180));
        CHECK(symmetry(turned) == degrees);
        // The symmetry maps a step along the direction to a step along the turned direction.
        const Direction d = direction_of(degrees), t = direction_of(turned);
        const Vec2 from = symmetry(grid_point(0.5, 0.5)).position();
        const Vec2 to = symmetry(grid_point(0.5 + 0.25 * d.x, 0.5 + 0.25 * d.y)).position();
        const double across = (to.x - from.x) * t.y - (to.y - from.y) * t.x;
        CHECK(std::abs(across) < 3 * 0x1p-16);
      }
    }
  }
}

TEST_CASE("library: as many sets as there are directions that no symmetry joins") {
  const TemporaryFolder folder;
  const PointSetLibrary by_five({.cache_folder = folder.path()});
  const PointSetLibrary by_one({.cache_folder = folder.path(), .pair_step = 1});
  const std::vector<SetName> single = by_five.names(1, 64);
  CHECK(single.size() == kShippedDirections);
  for (std::size_t i = 0; i < single.size(); ++i) {
    CHECK(single[i].directions == std::vector{static_cast<int>(i)});
  }
  CHECK(by_five.names(2, 64).size() == 153);
  CHECK(by_one.names(2, 64).size() == 4005);
  // Each pair of directions on the grid is served by one of these sets.
  const std::vector<SetName> pairs = by_five.names(2, 64);
  for (int a = 0; a < 180; a += 5) {
    for (int b = 0; b < 180; b += 5) {
      if (a == b || a % 90 == 0 || b % 90 == 0) continue;
      const SetChoice choice = choose_set(std::array{a, b}, 64);
      CHECK(std::ranges::count(pairs, choice.set) == 1);
      std::set<int> turned;
      for (const int d : choice.set.directions) turned.insert(choice.symmetry(d));
      CHECK(turned == std::set{a, b});
    }
  }
}

TEST_CASE("library: directions are rounded to those that there are") {
  const PointSetLibrary library({.cache_folder = "unused"});
  const auto snapped = [&](std::vector<double> wanted) { return library.snapped(wanted); };
  CHECK(snapped({}) == std::vector{0});
  CHECK(snapped({31.4}) == std::vector{31});
  CHECK(snapped({-0.6}) == std::vector{179});
  CHECK(snapped({179.6}) == std::vector{0});
  CHECK(snapped({89.9}) == std::vector{0});
  CHECK(snapped({377}) == std::vector{17});
  CHECK(snapped({112, 31.4}) == std::vector{30, 110});
  CHECK(snapped({177, 41.6}) == std::vector{40, 175});
  CHECK(snapped({178, 41.6}) == std::vector{42});  // every set contains the axis
  CHECK(snapped({31.4, 32}) == std::vector{31});
  CHECK(snapped({91, 178}) == std::vector{0});
  CHECK_THROWS_AS(snapped({10, 20, 30}), InputError);
  CHECK_THROWS_AS(PointSetLibrary({.pair_step = 4}), InputError);
  CHECK_THROWS_AS(PointSetLibrary({.pair_step = 0}), InputError);
}

TEST_CASE("library: sets are stratified along their angles and the axes, and there only") {
  const PointSetLibrary library({.cache_folder = "unused"});
  for (const std::uint32_t points : kShippedSizes) {
    CAPTURE(points);
    const PointSet grid = jittered_grid(points, 5);
    double along = 0, elsewhere = 0;  // sums of squares
    for (int degrees = 0; degrees < 180; ++degrees) {
      CAPTURE(degrees);
      const PointSet set = library.find(std::vector<double>{static_cast<double>(degrees)}, points);
      REQUIRE(set.size() == points);
      const double own = unevenness(set, degrees);
      const double most =
          points == 64 ? 1.1 : 0.8;  // most of their few frequencies belong to no direction
      CHECK(unevenness(set, 0) < most);
      CHECK(unevenness(set, 90) < most);
      CHECK(own < 1.7);
      if (points >= 1024 && degrees % 90 != 0) CHECK(own < 0.6 * unevenness(grid, degrees));
      along += square(own);
      // A direction as far from the set's own directions as possible.
      elsewhere += square(unevenness(set, degrees + (degrees % 45 < 22 ? 11 : -11)));
    }
    CHECK(along < square(points < 1024 ? 0.8 : 0.5) * elsewhere);
  }
  CHECK_FALSE(std::filesystem::exists("unused"));
}

TEST_CASE("library: the shipped sets are what synthesis makes") {
  for (const int degrees : {0, 1, 23, 45}) {
    const SetName name{64, {degrees}};
    CHECK(shipped_set(degrees, 64) == synthesize(settings_of(name)).points);
  }
  CHECK(shipped_set(30, 256) == synthesize(settings_of({256, {30}})).points);
  CHECK_FALSE(shipped_set(46, 64).has_value());
  CHECK_FALSE(shipped_set(-1, 64).has_value());
  CHECK_FALSE(shipped_set(1, 128).has_value());
}

}  // namespace pharos::aligned

#include <doctest/doctest.h>

#include <pharos/rendering/unit_plan.h>

namespace pharos {
namespace {

const std::vector<PixelRect> kTiles{{0, 0, 8, 8}, {8, 0, 16, 8}, {0, 8, 8, 12}};

void check_unit(const WorkUnit& unit, std::size_t tile, std::uint32_t first, std::uint32_t count) {
  CHECK(unit.iteration == 5);
  CHECK(unit.pixels.x0 == kTiles[tile].x0);
  CHECK(unit.pixels.y0 == kTiles[tile].y0);
  CHECK(unit.first_sample == first);
  CHECK(unit.sample_count == count);
}

TEST_CASE("unit plan: chunks cover all tiles one after another, and passes follow each other") {
  UnitPlan plan(kTiles, 5);
  plan.add(2, 7, 4);
  plan.add(9, 4, 64);
  REQUIRE(plan.count() == 9);
  check_unit(plan[0], 0, 2, 4);
  check_unit(plan[2], 2, 2, 4);
  check_unit(plan[3], 0, 6, 3);
  check_unit(plan[5], 2, 6, 3);
  check_unit(plan[6], 0, 9, 4);
  check_unit(plan[8], 2, 9, 4);
}

TEST_CASE("unit plan: a pass that has begun goes on with the units that are left") {
  UnitPlan plan(kTiles, 5);
  plan.add(2, 7, 4, 4);
  plan.add(9, 4, 64);
  REQUIRE(plan.count() == 5);
  check_unit(plan[0], 1, 6, 3);
  check_unit(plan[1], 2, 6, 3);
  check_unit(plan[2], 0, 9, 4);
}

}  // namespace
}  // namespace pharos

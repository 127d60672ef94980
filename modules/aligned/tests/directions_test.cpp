// Tests of the principal directions of integrands with known edges.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>

#include "../principal_directions.h"
#include "probed_integrands.h"

namespace pharos::aligned {
namespace {

using test::Integrand;

FreeDirections directions_of(const Integrand& integrand, int most, std::uint64_t seed = 1) {
  const ProbeGrid grid;
  return principal_directions(direction_histogram(test::values_of(integrand, grid, seed), grid, {}),
                              {}, most);
}

bool has_near(const FreeDirections& found, int direction, int degrees = 2) {
  for (const int f : found) {
    if (degrees_between(f, direction) <= degrees) return true;
  }
  return false;
}

/// Draws integrands of one kind and returns how many have a principal direction.
template <class Draw>
int accepted(int count, const Draw& draw) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    RandomStream random(11, static_cast<std::uint64_t>(i));
    found += directions_of(draw(random), kMostFree, 100 + static_cast<std::uint64_t>(i)).count > 0;
  }
  return found;
}

Vec2 inner_point(RandomStream& random) {
  const Vec2 u = random.next_2d();
  return {0.25f + 0.5f * u.x, 0.25f + 0.5f * u.y};
}

int free_direction(RandomStream& random) {
  while (true) {
    const int direction = static_cast<int>(random() % kDirections);
    if (degrees_from_axis(direction) >= 5) return direction;
  }
}

}  // namespace

TEST_CASE("directions: whole degrees that come back after 180") {
  CHECK(as_direction(-1) == 179);
  CHECK(as_direction(540) == 0);
  CHECK(degrees_between(179, 1) == 2);
  CHECK(degrees_between(10, 100) == 90);
  CHECK(degrees_from_axis(85) == 5);
  CHECK(degrees_from_axis(178) == 2);
  CHECK(degrees_from_axis(135) == 45);
  FreeDirections both;
  both.add(120);
  both.add(30);
  CHECK(std::vector<int>(both.begin(), both.end()) == std::vector<int>{30, 120});
}

TEST_CASE("probe grids: a point in each cell, tile after tile") {
  const ProbeGrid grid{.cells = 12, .tiles = 3};
  CHECK(grid.tile_edge() == 4);
  CHECK(grid.size() == 144);
  std::vector<int> counts(144);
  for (int tile = 0; tile < grid.tile_count(); ++tile) {
    for (const Vec2 u : grid.points(tile, 5)) {
      const int x = static_cast<int>(u.x * 12), y = static_cast<int>(u.y * 12);
      CHECK(y / 4 * 3 + x / 4 == tile);
      ++counts[static_cast<std::size_t>(y * 12 + x)];
    }
  }
  for (const int n : counts) CHECK(n == 1);
  CHECK(grid.points(4, 5) == grid.points(4, 5));
  CHECK_FALSE(grid.points(4, 5) == grid.points(4, 6));
}

TEST_CASE("principal directions: a step's normal, at every five degrees") {
  for (int direction = 0; direction < kDirections; direction += 5) {
    CAPTURE(direction);
    for (const Vec2 through : {Vec2{0.5f, 0.5f}, Vec2{0.45f, 0.55f}}) {
      const FreeDirections found = directions_of(test::half_plane(direction, through), 1);
      if (direction % 90 == 0) {
        CHECK(found.count == 0);
      } else {
        CHECK(found.count == 1);
        CHECK(has_near(found, direction));
      }
    }
  }
}

TEST_CASE("principal directions: edges that go down are those that go up") {
  const Integrand up = test::half_plane(35, {0.5f, 0.5f});
  const Integrand down = [&](Vec2 u) { return 3 - 2 * up(u); };
  CHECK(directions_of(up, 1) == directions_of(down, 1));
}

TEST_CASE("principal directions: two edges, and an edge beside one along an axis") {
  for (const auto& normals : {std::pair{30, 120}, {25, 65}, {60, 140}}) {
    const int a = normals.first, b = normals.second;
    CAPTURE(a);
    const FreeDirections found = directions_of(
        test::product(test::half_plane(a, {0.5f, 0.5f}), test::half_plane(b, {0.5f, 0.5f})), 2);
    CHECK(found.count == 2);
    CHECK(has_near(found, a));
    CHECK(has_near(found, b));
    const FreeDirections one = directions_of(
        test::product(test::half_plane(a, {0.5f, 0.5f}), test::half_plane(0, {0.4f, 0.5f})), 2);
    CHECK(one.count == 1);
    CHECK(has_near(one, a));
  }
}

TEST_CASE("principal directions: of three edges two, the stronger ones") {
  // The edges form a triangle. Its third side separates two levels with a smaller difference.
  const Vec2 center{0.5f, 0.45f};
  const Integrand wedge =
      test::product(test::half_plane(30, {0.25f, 0.5f}), test::half_plane(150, {0.75f, 0.5f}));
  const Integrand base = test::half_plane(75, center);
  const FreeDirections found = directions_of([&](Vec2 u) { return wedge(u) * (2 + base(u)); }, 2);
  CHECK(found.count == 2);
  CHECK(has_near(found, 30));
  CHECK(has_near(found, 150));
}

TEST_CASE("principal directions: none of what has no straight edge beside the axes") {
  CHECK(directions_of([](Vec2) { return 0.0f; }, 2).count == 0);
  CHECK(directions_of([](Vec2) { return 1e6f; }, 2).count == 0);
  CHECK(directions_of([](Vec2 u) { return 1 + u.x + 2 * u.y; }, 2).count == 0);
  RandomStream random(3);
  CHECK(directions_of([&](Vec2) { return random.next_1d(); }, 2).count == 0);
}

TEST_CASE("principal directions: labeled integrands, 200 of a kind") {
  const auto edge = [](RandomStream& random) {
    const int direction = free_direction(random);
    return test::half_plane(direction, inner_point(random));
  };
  CHECK(accepted(200, edge) >= 190);
  const auto round = [](RandomStream& random) {
    const Vec2 center = inner_point(random);
    return test::disk(center, 0.1f + 0.3f * random.next_1d());
  };
  CHECK(accepted(200, round) <= 10);
  const auto along_axes = [](RandomStream& random) {
    const Vec2 corner = inner_point(random);
    const Integrand left = test::half_plane(0, corner);
    return random.next_1d() < 0.5f ? left : test::product(left, test::half_plane(90, corner));
  };
  CHECK(accepted(200, along_axes) <= 10);
  const auto smooth = [](RandomStream& random) -> Integrand {
    const Vec2 center = inner_point(random), slope = random.next_2d();
    const float width = 0.1f + 0.4f * random.next_1d();
    return [=](Vec2 u) {
      const Vec2 d = u - center;
      return std::exp(-(d.x * d.x + d.y * d.y) / (2 * width * width)) + slope.x * u.x +
             slope.y * u.y;
    };
  };
  CHECK(accepted(200, smooth) <= 10);
}

TEST_CASE("principal directions: tiles may show pixels whose edges lie elsewhere") {
  const ProbeGrid grid;
  for (const int direction : {25, 65, 110, 160}) {
    CAPTURE(direction);
    RandomStream random(4, static_cast<std::uint64_t>(direction));
    std::vector<float> values;
    for (int tile = 0; tile < grid.tile_count(); ++tile) {
      const float place = 0.3f + 0.4f * random.next_1d();
      const Integrand edge = test::half_plane(direction, {place, place});
      for (const Vec2 u : grid.points(tile, 8)) values.push_back(edge(u));
    }
    const FreeDirections found = principal_directions(direction_histogram(values, grid, {}), {}, 2);
    CHECK(found.count == 1);
    CHECK(has_near(found, direction, 3));
  }
}

}  // namespace pharos::aligned

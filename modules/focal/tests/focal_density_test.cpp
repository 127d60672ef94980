#include "../focal_density.h"

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>

#include "test_trees.h"

namespace pharos::focal {
namespace {

using namespace testing;

struct Origin {
  const char* name;
  Point3 point;
};

/// Origins inside the box; on faces, edges and corners of the box and of cells; in the hot cells;
/// and outside.
std::vector<Origin> origins() {
  const Box box = test_box();
  const auto at = [&](float x, float y, float z) {
    return Point3{static_cast<float>(box.low[0] + x * box.size[0]),
                  static_cast<float>(box.low[1] + y * box.size[1]),
                  static_cast<float>(box.low[2] + z * box.size[2])};
  };
  return {{"inside", at(0.31f, 0.67f, 0.12f)},      {"on a face", at(0, 0.4f, 0.6f)},
          {"on an edge", at(0, 1, 0.3f)},           {"on a corner", at(1, 1, 1)},
          {"the center", at(0.5f, 0.5f, 0.5f)},     {"in the hot cell", {0.3f, 1.1f, 4.2f}},
          {"near the pinhole", {0.1f, 1.3f, 3.6f}}, {"outside", at(1.5f, 0.5f, 0.4f)}};
}

}  // namespace

TEST_CASE("focal density: directions fit their density, which integrates to one") {
  for (const NamedDensity& named : test_densities()) {
    for (const Origin& origin : origins()) {
      CAPTURE(named.name);
      CAPTURE(origin.name);
      const auto draw = [&](RandomStream& random) {
        const float sign = random.next_1d();
        const Vec2 u = random.next_2d();
        return named.density.sample_direction(origin.point, sign, {u.x, u.y, random.next_1d()});
      };
      const auto density = [&](Vec3 direction) {
        return named.density.directional_density(origin.point, direction);
      };
      const auto fit = statistics::fit_direction_density(
          draw, density, {.draws = 40'000, .seed = 9, .cells = 60, .quadrature_tolerance = 2e-4});
      CHECK(fit.is_density());
      CHECK(fit.integral == doctest::Approx(1).epsilon(1e-3 + fit.integral_error));
      // The test makes 48 fits. At this level, a correct sampler fails one run in 2,000.
      CHECK(fit.chi_square.p_value > 1e-5);
      CHECK(fit.missed == 0);
    }
  }
}

TEST_CASE("focal density: a diverging point is aimed away from") {
  FocalDensity density{Octree(test_box(), {Octree::Node{}}), one_hot_tree()};
  const Point3 from{-1, 0.5f, 3}, hot{0.3f, 1.1f, 4.2f};
  const auto direction = density.sample_direction(from, 0.5f, {0.3, 0.6, 0.2});
  REQUIRE(direction);
  CHECK(dot(*direction, normalize(from - hot)) == doctest::Approx(1).epsilon(1e-5));
  CHECK(density.directional_density(from, *direction) > 1);
  CHECK(density.directional_density(from, -*direction) == 0);
}

}  // namespace pharos::focal

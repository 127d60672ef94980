#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>

#include "../camera_mixture.h"
#include "../first_distribution.h"
#include "test_proposals.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

CameraMixture wall_mixture(int count) {
  std::vector<FirstVertex> components;
  RandomStream random(11);
  for (int i = 0; i < count; ++i) {
    Gaussian<3> g = any_gaussian<3>(random, 0.3, 0.2);
    g.mean = Vector<3>(4 * random.next_1d() - 2, 4 * random.next_1d() - 2, 3);
    components.push_back({spatial(g, 1.0f / static_cast<float>(count)), VertexKind::surface});
  }
  return CameraMixture(std::move(components));
}

TEST_CASE("camera: the hierarchy finds all components around a point") {
  for (const int count : {0, 1, 4, 5, 100, 3000}) {
    const CameraMixture mixture = wall_mixture(count);
    RandomStream random(12);
    for (int i = 0; i < 200; ++i) {
      const Vec2 u = random.next_2d();
      const Point3 p{5 * u.x - 2.5f, 5 * u.y - 2.5f, 2 + 2 * random.next_1d()};
      std::vector<std::size_t> found, expected;
      mixture.for_each_around(p, [&](std::size_t k) { found.push_back(k); });
      for (std::size_t k = 0; k < mixture.size(); ++k) {
        if (box_around(mixture[k].gaussian).contains(p)) expected.push_back(k);
      }
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
    }
  }
}

TEST_CASE(
    "camera: what is met on a wall follows its density (2D), outside of boxes it is nothing") {
  const CameraMixture mixture = wall_mixture(12);
  const Point3 lens{0.1f, 0.2f, -1};
  const FirstDistribution guide(mixture, lens);
  const auto seen = [&](Vec3 direction) -> std::optional<ResolvedVertex> {
    if (!(direction.z > 0)) return std::nullopt;
    // The wall is inclined, so parts of it are outside of the boxes.
    const float t = (3 - lens.z) / (direction.z + 0.4f * direction.x);
    if (!(t > 0)) return std::nullopt;
    return ResolvedVertex{.direction = direction,
                          .distance = t,
                          .position = lens + t * direction,
                          .event = Event::smooth_reflect};
  };
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    const auto proposal = propose(guide, random);
    const auto first = proposal ? seen(proposal->direction) : std::nullopt;
    if (!first || !proposal->accepts(first->kind, first->position)) return std::nullopt;
    return proposal->direction;
  };
  const auto density = [&](Vec3 direction) -> double {
    const auto first = seen(direction);
    return first ? guide.density(*first) : 0;
  };
  const auto fit = statistics::fit_direction_density(draw, density);
  CHECK(fit.outside_support == 0);
  CHECK(fit.missed > 0.001);
  CHECK(fit.integral + fit.missed == doctest::Approx(1).epsilon(4e-3));
  CHECK(fit.chi_square.p_value > 1e-4);
}

}  // namespace
}  // namespace pharos::vertex_triplets

#include "../projections.h"

#include <algorithm>

#include <doctest/doctest.h>

#include <pharos/guiding/toolkit/seen_gaussian.h>

#include "../truncated_normal.h"
#include "test_gaussians.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

constexpr Point3 kOrigin{0.3f, -2, 1};

/// Returns eight Gaussians with deviations between 1e-3 and 1 times `size`, at this distance.
NextGroup any_group(float size, float distance, RandomStream& random) {
  NextGroup group;
  group.clear();
  for (unsigned lane = 0; lane < NextGroup::kLanes; ++lane) {
    SpatialGaussian g = spatial(any_gaussian<3>(random, size, 1e-3), 0.125f);
    g.mean = kOrigin + distance * warp::sphere_from_square(random.next_2d());
    group.set(lane, g);
  }
  return group;
}

TEST_CASE("projections: eight at once agree with the density of one in double precision") {
  constexpr double kMass = kTruncatedMass * kTruncatedMass;
  RandomStream random(4);
  int compared = 0;
  for (const float distance : {0.1f, 1.0f, 10.0f}) {
    for (int run = 0; run < 20; ++run) {
      const NextGroup group = any_group(0.3f, distance, random);
      const Projections projections(group, kOrigin);
      for (unsigned lane = 0; lane < NextGroup::kLanes; ++lane) {
        const SpatialGaussian g = group.gaussian(lane);
        CHECK(projections.possible(1e-6f)[lane] != 0);
        const Vec3 direction = projections.sample(lane, random.next_2d());
        const float density = projections.densities(direction)[lane];
        const double expected = projected_density(g, kOrigin, direction) / kMass;
        // Directions are floats, which moves points of narrow Gaussians far away. A rounded
        // direction may even lie beyond the truncation.
        const double narrowest = std::min({g.cholesky[0], g.cholesky[2], g.cholesky[5]});
        const double slip = 1e-6 * distance / narrowest;
        if (density == 0 || slip > 2e-3) continue;
        ++compared;
        CHECK(density == doctest::Approx(expected).epsilon(1e-4 + 4 * slip));
      }
    }
  }
  CHECK(compared > 250);
}

TEST_CASE("projections: nothing is behind the origin, beyond the truncation, or at the mean") {
  NextGroup group;
  group.clear();
  group.set(2, {1, kOrigin + Vec3{0, 0, 2}, {0.1f, 0, 0.1f, 0, 0, 0.1f}});
  group.set(5, {1, kOrigin, {1, 0, 1, 0, 0, 1}});
  const Projections projections(group, kOrigin);
  CHECK(projections.densities({0, 0, 1})[2] > 0);
  CHECK(projections.densities({0, 0, -1})[2] == 0);
  CHECK(projections.densities(normalize(Vec3{0.39f, 0, 2}))[2] > 0);
  CHECK(projections.densities(normalize(Vec3{0.41f, 0, 2}))[2] == 0);
  CHECK(projections.possible(0)[5] == 0);
  CHECK(projections.densities({0, 0, 1})[5] == 0);
}

}  // namespace
}  // namespace pharos::vertex_triplets

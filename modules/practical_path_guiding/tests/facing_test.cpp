#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../learner.h"
#include "../model.h"
#include "guided_paths.h"

namespace pharos::practical_path_guiding {
namespace {

constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

/// Returns paths with one guidable step each, from both sides of a thin board. The side is random.
/// Radiance 1 arrives from all directions above the board, and radiance 3 from all directions
/// below.
PathLog board_paths(int count, std::uint64_t seed) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    const bool above = random.next_1d() < 0.5f;
    Vec3 direction = warp::sphere_from_square(random.next_2d());
    direction.z = above ? std::abs(direction.z) : -std::abs(direction.z);
    add_step(log,
             {.position = {u.x, u.y, 0.5f},
              .normal = above ? kUp : kDown,
              .direction = direction,
              .pdf = 2 * warp::sphere_pdf()},
             Rgb(above ? 1.0f : 3.0f));
  }
  return log;
}

PracticalPathGuidingSettings settings(bool by_facing) {
  return {.spatial_threshold = 1000, .by_facing = by_facing};
}

Learned trained(bool by_facing) {
  Bounds3 region;
  region.add(Point3{0, 0, 0});
  region.add(Point3{1, 1, 1});
  const auto state = PracticalPathGuidingLearner(settings(by_facing))
                         .begin({.region = region, .seed = 7, .window = {0, 0, 10, 10}});
  Learned learned;
  for (std::uint32_t i = 0; i < 3; ++i) {
    state->absorb(board_paths(4000 << i, i));
    learned = state->update({i, 2 - i});
  }
  return learned;
}

const PracticalPathGuidingModel& as_tree(const Learned& learned) {
  return dynamic_cast<const PracticalPathGuidingModel&>(*learned.model);
}

constexpr Point3 kAt{0.4f, 0.6f, 0.5f};

/// Returns the part of the directions above the board that the guide of one of its sides samples.
double share_above(const PracticalPathGuidingModel& tree, Vec3 normal) {
  const QuadDensity density(tree.nodes(tree.place({.position = kAt, .normal = normal}).region));
  RandomStream random(3);
  constexpr int kDraws = 2000;
  int above = 0;
  for (int i = 0; i < kDraws; ++i) {
    above += warp::sphere_from_square(density.sample(random.next_2d())).z > 0 ? 1 : 0;
  }
  return static_cast<double>(above) / kDraws;
}

TEST_CASE("a normal faces along the axis of its largest component") {
  CHECK(facing_of({0.9f, 0.1f, -0.2f}) == 0);
  CHECK(facing_of({-0.9f, 0.1f, -0.2f}) == 1);
  CHECK(facing_of({0.1f, 0.9f, -0.2f}) == 2);
  CHECK(facing_of({0.1f, -0.9f, -0.2f}) == 3);
  CHECK(facing_of(kUp) == 4);
  CHECK(facing_of(kDown) == 5);
  CHECK(facing_of({}) == 0);
}

TEST_CASE("the sides of a board are guided apart only if surfaces learn by their facing") {
  const Learned apart = trained(true), together = trained(false);
  // The directional filter spreads some light over the edge of the board.
  CHECK(share_above(as_tree(apart), kUp) > 0.95);
  CHECK(share_above(as_tree(apart), kDown) < 0.05);
  CHECK(share_above(as_tree(together), kUp) == share_above(as_tree(together), kDown));
  CHECK(share_above(as_tree(together), kUp) == doctest::Approx(0.25).epsilon(0.2));
  CHECK(as_tree(apart).place({.position = kAt, .normal = {1, 0, 0}}).evidence == 0);
}

TEST_CASE("cells by facing: the radiance that they expect, and where they come from") {
  const Learned learned = trained(true);
  CHECK(as_tree(learned).incident_radiance(kAt, kUp) == doctest::Approx(1).epsilon(0.1));
  CHECK(as_tree(learned).incident_radiance(kAt, kDown) == doctest::Approx(3).epsilon(0.1));
  CHECK(as_tree(learned).density(kAt, nullptr) > 0);
  REQUIRE(learned.region_origins.size() == learned.model->info().regions);
  for (std::size_t i = 0; i < learned.region_origins.size(); ++i) {
    CHECK(learned.region_origins[i] % kFacings == i % kFacings);
  }
}

TEST_CASE(
    "cells by facing survive being saved, and replace the cells of the model that loads them") {
  const Learned learned = trained(true);
  const std::string file = test::saved(*learned.model);
  std::istringstream in(file);
  const auto model = PracticalPathGuidingLearner(settings(false)).empty_model();
  load(in, *model);
  CHECK(test::saved(*model) == file);
}

}  // namespace
}  // namespace pharos::practical_path_guiding

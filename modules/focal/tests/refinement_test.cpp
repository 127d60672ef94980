#include <cmath>

#include <doctest/doctest.h>

#include "test_trees.h"

namespace pharos::focal {
namespace {

using namespace testing;

/// Returns the index of the node that the path of child numbers reaches from the root.
std::uint32_t node_at(const Octree& octree, std::initializer_list<unsigned> path) {
  std::uint32_t node = 0;
  for (const unsigned c : path) {
    REQUIRE(!octree.nodes()[node].is_leaf(c));
    node = octree.nodes()[node].index(c);
  }
  return node;
}

}  // namespace

TEST_CASE("refinement: even mass gives a grid of 16 cells an edge at the paper's threshold") {
  const LearningOctree even = refined(uniform_octree(test_box(), 1), {.threshold = 1e-3});
  CHECK(even.octree.nodes().size() == 1 + 8 + 64 + 512);
  CHECK(even.octree.depth() == 4);
  CHECK(even.mass() == doctest::Approx(1));
  CHECK(even.octree.mass() == doctest::Approx(1));
  CHECK(even.octree.density({0, 1, 3}) == doctest::Approx(1 / test_box().volume()));
}

TEST_CASE("refinement: a heavy leaf is divided over several levels at once") {
  LearningOctree learned = uniform_octree(test_box(), 1);
  learned.masses = {0.9, 0, 0, 0, 0, 0, 0, 0.1};
  const LearningOctree finer = refined(learned, {.threshold = 0.05});
  const Octree& octree = finer.octree;
  // 0.9 and 0.9 / 8 exceed 0.05; 0.9 / 64 and 0.1 / 8 do not.
  const std::uint32_t inner = node_at(octree, {0, 5});
  for (unsigned c = 0; c < 8; ++c) {
    CHECK(octree.nodes()[inner].is_leaf(c));
    CHECK(finer.masses[8 * inner + c] == doctest::Approx(0.9 / 64));
  }
  CHECK(octree.nodes()[node_at(octree, {7})].is_leaf(0));
  CHECK(octree.nodes()[0].is_leaf(3));
  CHECK(finer.mass() == doctest::Approx(1));
}

TEST_CASE("refinement: no cell is finer than the greatest depth") {
  LearningOctree learned = uniform_octree(test_box(), 1);
  learned.masses = {1, 0, 0, 0, 0, 0, 0, 0};
  CHECK(refined(learned, {.threshold = 1e-6, .max_depth = 0}).octree.depth() == 1);
  CHECK(refined(learned, {.threshold = 1e-6, .max_depth = 2}).octree.depth() == 3);
}

TEST_CASE("refinement: light nodes become leaves with all of their mass, over several levels") {
  LearningOctree learned = refined(uniform_octree(test_box(), 1), {.threshold = 1e-2});
  REQUIRE(learned.octree.depth() > 1);
  // Nearly all mass moves into one corner.
  for (double& mass : learned.masses) mass *= 1e-4;
  learned.masses[8 * node_at(learned.octree, {0, 0}) + 0] = 1;
  const double before = learned.mass();
  const LearningOctree coarser =
      refined(learned, {.threshold = 1e-2, .max_depth = 4, .total_mass = before});
  CHECK(coarser.octree.nodes()[0].is_leaf(7));
  CHECK(coarser.masses[7] == doctest::Approx(1e-4 / 8));
  CHECK(coarser.mass() == doctest::Approx(before).epsilon(1e-12));
  CHECK(coarser.octree.mass() == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("enlarging: the same cells with the same masses in a box of twice the size") {
  LearningOctree learned = refined(uniform_octree(test_box(), 1), {.threshold = 0.1});
  for (std::size_t i = 0; i < learned.masses.size(); ++i) {
    if (learned.masses[i] > 0) learned.masses[i] = 1 + static_cast<double>(i);
  }
  const double mass = learned.mass();
  const SplitRule rule{.threshold = 0.01, .total_mass = mass};
  learned = refined(learned, rule);
  const LearningOctree larger = refined(enlarged(learned), rule);
  CHECK(larger.mass() == doctest::Approx(mass));
  CHECK(larger.octree.box() == Box{{-3, -0.75, -0.25}, {6, 4, 9}});
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const Point3 p = point_in_box(random, test_box());
    CHECK(larger.octree.density(p) == doctest::Approx(learned.octree.density(p)));
  }
  CHECK(larger.octree.density({-1.6f, 1, 3}) == 0);
}

TEST_CASE("enlarging: what is densest at the boundary is noticed") {
  // The octree has two levels of leaves. Its densest leaf is child `c` of the root's child 0.
  const auto is_noticed = [](unsigned c) {
    LearningOctree learned = refined(uniform_octree(test_box(), 1), {.threshold = 0.1});
    learned.masses[8 * node_at(learned.octree, {0}) + c] = 1;
    const SplitRule rule{.threshold = 0.01, .max_depth = 1, .total_mass = learned.mass()};
    return is_densest_at_boundary(refined(learned, rule).octree);
  };
  for (unsigned c = 0; c < 7; ++c) CHECK(is_noticed(c));
  CHECK(!is_noticed(7));
}

TEST_CASE("pruning: even nodes vanish, uneven ones stay, mass is kept") {
  const Octree even = even_tree();
  CHECK(pruned(even, 2).nodes().size() == 1);
  CHECK(pruned(even, 2).mass() == doctest::Approx(1).epsilon(1e-6));
  CHECK(pruned(even, 0.5).nodes() == even.nodes());

  LearningOctree learned = refined(uniform_octree(test_box(), 1), {.threshold = 0.1});
  REQUIRE(learned.octree.depth() == 2);
  // Child 0 has one leaf twice as dense as the mean of its node, within the ratio. Child 1 has a
  // slightly denser leaf, above the ratio.
  for (unsigned k = 0; k < 2; ++k) {
    const std::size_t node = node_at(learned.octree, {k});
    const double peak = k == 0 ? 2 : 2.01;
    for (unsigned c = 0; c < 8; ++c) {
      learned.masses[8 * node + c] = c == 0 ? peak : (8 - peak) / 7;
    }
  }
  const Octree octree =
      refined(learned, {.threshold = 0.05, .max_depth = 1, .total_mass = learned.mass()}).octree;
  const Octree cut = pruned(octree, 2 + 1e-6);
  CHECK(cut.nodes()[0].is_leaf(0));
  CHECK(!cut.nodes()[0].is_leaf(1));
  CHECK(cut.mass() == doctest::Approx(octree.mass()).epsilon(1e-6));
}

}  // namespace pharos::focal

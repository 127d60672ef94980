#pragma once

#include <string>
#include <vector>

#include <pharos/core/random.h>

#include "../focal_density.h"
#include "../octree_refinement.h"

namespace pharos::focal::testing {

/// A box with three different edges, away from the origin.
inline Box test_box() {
  return {{-1.5, 0.25, 2}, {3, 2, 4.5}};
}

/// Returns the tree learned from `draws` points that `draw(random)` returns, refined in a few
/// rounds.
template <class DrawPoint>
Octree tree_of_points(const SplitRule& rule, int draws, std::uint64_t seed, DrawPoint&& draw) {
  LearningOctree learned = refined(uniform_octree(test_box(), 1), rule);
  RandomStream random(seed);
  for (int round = 0; round < 6; ++round) {
    std::fill(learned.masses.begin(), learned.masses.end(), 0.0);
    for (int i = 0; i < draws; ++i) {
      const Point3 p = draw(random);
      Box cell = learned.octree.box();
      if (!cell.contains(p)) continue;
      std::uint32_t node = 0;
      while (true) {
        unsigned c = 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
          const double middle = cell.low[axis] + 0.5 * cell.size[axis];
          c |= static_cast<unsigned>(p[static_cast<int>(axis)] >= middle) << axis;
        }
        if (learned.octree.nodes()[node].is_leaf(c)) {
          learned.masses[8 * node + c] += 1;
          break;
        }
        cell = cell.child(c);
        node = learned.octree.nodes()[node].index(c);
      }
    }
    learned = refined(learned, {rule.threshold, rule.max_depth, learned.mass()});
  }
  return learned.octree;
}

inline Point3 point_in_box(RandomStream& random, const Box& box) {
  const Vec2 u = random.next_2d();
  const double v = random.next_1d();
  return {static_cast<float>(box.low[0] + u.x * box.size[0]),
          static_cast<float>(box.low[1] + u.y * box.size[1]),
          static_cast<float>(box.low[2] + v * box.size[2])};
}

/// Returns a random point around `center`, within `radius` along each axis.
inline Point3 point_near(RandomStream& random, Point3 center, float radius) {
  const Vec2 u = random.next_2d();
  return center + radius * Vec3{2 * u.x - 1, 2 * u.y - 1, 2 * random.next_1d() - 1};
}

inline Octree even_tree() {
  return refined(uniform_octree(test_box(), 1), {.threshold = 1e-2}).octree;
}
/// Returns a tree with cells of random sizes and random masses.
inline Octree random_tree(std::uint64_t seed) {
  LearningOctree learned = refined(uniform_octree(test_box(), 1), {.threshold = 5e-2});
  RandomStream random(seed);
  for (int round = 0; round < 3; ++round) {
    for (double& mass : learned.masses) {
      if (mass > 0) mass *= random.next_1d() < 0.5f ? 0.01 : 10 * random.next_1d();
    }
    learned = refined(learned, {.threshold = 1e-2, .total_mass = learned.mass()});
  }
  return learned.octree;
}
/// Returns a tree like the one learned for a camera obscura: a small hole in a wall, two lamps, and
/// a small uniform density.
inline Octree pinhole_tree(float radius = 0.02f) {
  return tree_of_points({.threshold = 5e-3}, 20'000, 3, [&](RandomStream& random) {
    const float u = random.next_1d();
    if (u < 0.6f) return point_near(random, {0.1f, 1.3f, 3.7f}, radius);
    if (u < 0.8f) return point_near(random, {-1.2f, 2.1f, 5.5f}, 0.1f);
    return point_in_box(random, test_box());
  });
}
/// Returns a tree with all mass in one cell at the maximum depth.
inline Octree one_hot_tree() {
  return tree_of_points({.threshold = 5e-2}, 2'000, 4, [](RandomStream&) {
    return Point3{0.3f, 1.1f, 4.2f};
  });
}

struct NamedDensity {
  std::string name;
  FocalDensity density;
};

/// Densities of converging points only, and of both converging and diverging points. The masses of
/// the two trees sum to one.
inline std::vector<NamedDensity> test_densities() {
  const auto share = [](const Octree& octree, float factor) {
    std::vector<Octree::Node> nodes = octree.nodes();
    for (Octree::Node& node : nodes) {
      for (unsigned c = 0; c < 8; ++c) {
        if (node.is_leaf(c)) node.set_density(c, factor * node.density(c));
      }
    }
    return Octree(octree.box(), std::move(nodes));
  };
  const auto pair = [&](const Octree& a, const Octree& b, float share_of_b) {
    return FocalDensity{share(a, 1 - share_of_b), share(b, share_of_b)};
  };
  return {{"even", pair(even_tree(), even_tree(), 0.5f)},
          {"random", pair(random_tree(1), random_tree(2), 0.3f)},
          {"pinhole", pair(pinhole_tree(), even_tree(), 0.1f)},
          {"pinhole behind", pair(even_tree(), pinhole_tree(), 0.8f)},
          {"one hot cell", pair(one_hot_tree(), even_tree(), 0.05f)},
          {"converging only", pair(random_tree(3), even_tree(), 0)}};
}

}  // namespace pharos::focal::testing

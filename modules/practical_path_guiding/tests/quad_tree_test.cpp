#include "../quad_tree.h"

#include <cmath>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/tests/fixtures.h>

namespace pharos::practical_path_guiding {
namespace {

using test::saved;

/// Returns a tree for a density with a narrow peak at `peak`, refined twice.
QuadTree peaked(Vec2 peak, LeafMass kind = LeafMass::sum) {
  const QuadRefinement rule;
  QuadTree tree(rule);
  RandomStream random(3);
  for (int iteration = 0; iteration < 3; ++iteration) {
    if (iteration > 0) tree = tree.refined(kind, rule);
    for (int i = 0; i < 4000; ++i) {
      const Vec2 u = random.next_2d();
      const float x = peak.x + 0.02f * (u.x - 0.5f), y = peak.y + 0.02f * (u.y - 0.5f);
      const bool is_peak = i % 2 == 0;
      tree.add(is_peak ? Vec2{x, y} : random.next_2d(), 0.5 + random.next_1d());
    }
  }
  return tree;
}

/// Returns the integral of a density over the unit square, by its values on a regular grid. It is
/// exact if the grid is as fine as the leaves.
double integral(const QuadDensity& density, int cells = 512) {
  double sum = 0;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      sum += density.at({(static_cast<float>(x) + 0.5f) / static_cast<float>(cells),
                         (static_cast<float>(y) + 0.5f) / static_cast<float>(cells)});
    }
  }
  return sum / (static_cast<double>(cells) * cells);
}

TEST_CASE("an empty tree is refined evenly, down to the share a leaf may have") {
  // 4^-3 is above 0.01, but 4^-4 is not. This gives 16 x 16 leaves and 1 + 4 + 16 + 64 nodes.
  CHECK(QuadTree(QuadRefinement{}).node_count() == 85);
  CHECK(QuadTree({.threshold = 1}).node_count() == 1);
  CHECK(QuadTree({.threshold = 0.3}).node_count() == 1);
  CHECK(QuadTree({.threshold = 0.2}).node_count() == 5);
  CHECK(QuadTree({.threshold = 1e-9, .max_depth = 3}).node_count() == 1 + 4 + 16);
}

TEST_CASE("densities integrate to one and are what their leaves hold") {
  QuadTree tree({.threshold = 0.2});  // 4 x 4 leaves
  tree.add({0.1f, 0.1f}, 1);
  tree.add({0.9f, 0.1f}, 3);
  const std::vector<QuadNode> nodes = tree.density(LeafMass::sum);
  const QuadDensity density(nodes);
  CHECK(density.at({0.2f, 0.2f}) == doctest::Approx(0.25 * 16));
  CHECK(density.at({0.8f, 0.2f}) == doctest::Approx(0.75 * 16));
  CHECK(density.at({0.8f, 0.3f}) == 0);
  CHECK(integral(density, 64) == doctest::Approx(1));
  const std::vector<QuadNode> peak = peaked({0.3f, 0.7f}).density(LeafMass::sum);
  CHECK(integral(QuadDensity(peak)) == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("second moments become the root of area times sum") {
  QuadTree tree({.threshold = 0.2});
  tree.add({0.1f, 0.1f}, 1);
  tree.add({0.9f, 0.1f}, 9);
  const std::vector<QuadNode> nodes = tree.density(LeafMass::root);
  CHECK(QuadDensity(nodes).at({0.1f, 0.1f}) == doctest::Approx(0.25 * 16));
  CHECK(QuadDensity(nodes).at({0.9f, 0.1f}) == doctest::Approx(0.75 * 16));
  // For the same sum, a leaf with a quarter of the area has half of the mass.
  QuadTree uneven = QuadTree({.threshold = 1});
  uneven.add({0.1f, 0.1f}, 4);
  uneven.add({0.9f, 0.1f}, 1);
  uneven = uneven.refined(LeafMass::sum, {.threshold = 0.5});
  REQUIRE(uneven.node_count() == 2);
  uneven.add({0.1f, 0.1f}, 1);
  uneven.add({0.9f, 0.1f}, 1);
  const std::vector<QuadNode> mixed = uneven.density(LeafMass::root);
  CHECK(QuadDensity(mixed).at({0.1f, 0.1f}) == doctest::Approx(16.0 / 3));
  CHECK(QuadDensity(mixed).at({0.9f, 0.1f}) == doctest::Approx(4 * 2.0 / 3));
}

TEST_CASE("refinement keeps the flux and divides what has more than its share") {
  const QuadTree tree = peaked({0.3f, 0.7f});
  const QuadRefinement rule{.threshold = 0.004};
  QuadTree finer = tree.refined(LeafMass::sum, rule);
  CHECK(finer.total() == 0);
  CHECK(finer.node_count() > tree.node_count());
  // Filled with samples of the density, the finer tree represents the same density.
  const std::vector<QuadNode> nodes = tree.density(LeafMass::sum);
  const QuadDensity density(nodes);
  constexpr int kGrid = 1024;
  double most = 0;
  for (int y = 0; y < kGrid; ++y) {
    for (int x = 0; x < kGrid; ++x) {
      const Vec2 p{(static_cast<float>(x) + 0.5f) / kGrid, (static_cast<float>(y) + 0.5f) / kGrid};
      finer.add(p, density.at(p));
    }
  }
  const std::vector<QuadNode> same = finer.density(LeafMass::sum);
  for (const Vec2 p : {Vec2{0.3f, 0.7f}, {0.305f, 0.695f}, {0.1f, 0.1f}, {0.99f, 0.5f}}) {
    most = std::max(most, std::abs(double{QuadDensity(same).at(p)} / density.at(p) - 1));
  }
  CHECK(most < 1e-5);
}

TEST_CASE("quarters are divided exactly where they have more than their share") {
  const QuadTree tree = peaked({0.3f, 0.7f});
  const QuadRefinement rule{.threshold = 0.02, .max_depth = 6};
  // The refined tree is filled with the density of the old one.
  const std::vector<QuadNode> old = tree.density(LeafMass::sum);
  QuadTree refined = tree.refined(LeafMass::sum, rule);
  constexpr int kGrid = 1024;
  for (int y = 0; y < kGrid; ++y) {
    for (int x = 0; x < kGrid; ++x) {
      const Vec2 p{(static_cast<float>(x) + 0.5f) / kGrid, (static_cast<float>(y) + 0.5f) / kGrid};
      refined.add(p, QuadDensity(old).at(p));
    }
  }
  const std::vector<QuadNode> nodes = refined.density(LeafMass::sum);
  std::vector<int> level(nodes.size(), 1);
  std::vector<double> mass(nodes.size(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (unsigned q = 0; q < 4; ++q) {
      const double share = mass[i] * nodes[i].share(q);
      const bool is_divided = nodes[i].is_divided(q);
      if (is_divided) {
        level[nodes[i].child(q)] = level[i] + 1;
        mass[nodes[i].child(q)] = share;
      }
      if (std::abs(share - rule.threshold) < 1e-6) continue;
      CHECK(is_divided == (share > rule.threshold && level[i] < rule.max_depth));
    }
  }
}

/// Returns a tree that is refined for another one and has a part of its values.
QuadTree refined_part(const QuadTree& tree, LeafMass kind, const QuadRefinement& rule,
                      double part) {
  QuadTree refined = tree.refined(kind, rule);
  CHECK(refined.total() == 0);
  refined.add(tree, part, false);
  return refined;
}

TEST_CASE("a refined tree can take over a part of all values") {
  const QuadTree tree = peaked({0.3f, 0.7f});
  for (const LeafMass kind : {LeafMass::sum, LeafMass::root}) {
    for (const double threshold : {0.3, 0.01, 0.001}) {
      const QuadTree half = refined_part(tree, kind, {.threshold = threshold}, 0.5);
      CHECK(half.node_count() == tree.refined(kind, {.threshold = threshold}).node_count());
      CHECK(half.total() == doctest::Approx(0.5 * tree.total()).epsilon(1e-12));
      // Both densities have the same integral over a square that no leaf of either tree exceeds.
      const std::vector<QuadNode> before = tree.density(LeafMass::sum);
      const std::vector<QuadNode> after = half.density(LeafMass::sum);
      double least = 1, most = 1;
      for (unsigned q = 0; q < 4; ++q) {
        const auto mass = [&](const std::vector<QuadNode>& nodes) { return nodes[0].share(q); };
        least = std::min(least, double{mass(after) / mass(before)});
        most = std::max(most, double{mass(after) / mass(before)});
      }
      CHECK(least == doctest::Approx(1));
      CHECK(most == doctest::Approx(1));
    }
  }
  // Finer leaves share what a leaf had.
  const std::vector<QuadNode> coarse = tree.density(LeafMass::sum);
  const std::vector<QuadNode> fine =
      refined_part(tree, LeafMass::sum, {.threshold = 1e-3}, 1).density(LeafMass::sum);
  RandomStream random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = random.next_2d();
    CHECK(QuadDensity(fine).at(p) == doctest::Approx(QuadDensity(coarse).at(p)));
  }
}

TEST_CASE("added trees give the mixture of both densities, and finer leaves where one has them") {
  const QuadTree a = peaked({0.3f, 0.7f}), b = peaked({0.6f, 0.2f});
  const std::vector<QuadNode> of_a = a.density(LeafMass::sum), of_b = b.density(LeafMass::sum);
  QuadTree both = a;
  both.add(b, 2, true);
  CHECK(both.node_count() > std::max(a.node_count(), b.node_count()));
  CHECK(both.total() == doctest::Approx(a.total() + 2 * b.total()));
  const std::vector<QuadNode> mixture = both.density(LeafMass::sum);
  const double share = a.total() / both.total();
  RandomStream random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = i % 2 == 0 ? random.next_2d() : Vec2{0.6f, 0.2f} + 0.02f * random.next_2d();
    CHECK(QuadDensity(mixture).at(p) ==
          doctest::Approx(share * QuadDensity(of_a).at(p) + (1 - share) * QuadDensity(of_b).at(p))
              .epsilon(1e-3));
  }

  QuadTree same_leaves = a;
  same_leaves.add(b, 2, false);
  CHECK(same_leaves.node_count() == a.node_count());
  CHECK(same_leaves.total() == doctest::Approx(both.total()));
  // A square that both divide keeps its mass.
  const std::vector<QuadNode> coarse = same_leaves.density(LeafMass::sum);
  for (unsigned q = 0; q < 4; ++q)
    CHECK(coarse[0].share(q) == doctest::Approx(mixture[0].share(q)));
}

TEST_CASE("smoothed trees have the shares of values that are spread in every square") {
  QuadTree tree({.threshold = 0.2});  // 4 x 4 leaves
  tree.add({0.1f, 0.1f}, 3);
  const QuadTree smooth = tree.smoothed(1);
  CHECK(smooth.total() == doctest::Approx(3));
  const std::vector<QuadNode> nodes = smooth.density(LeafMass::sum);
  // Of every square with the value 3: (3 + 1/4) / 4 for the quarter with it, 1/16 for the others.
  // Squares without values are even.
  const QuadDensity density(nodes);
  CHECK(density.at({0.1f, 0.1f}) == doctest::Approx(16 * 0.8125 * 0.8125));
  CHECK(density.at({0.3f, 0.1f}) == doctest::Approx(16 * 0.8125 * 0.0625));
  CHECK(density.at({0.9f, 0.6f}) == doctest::Approx(4 * 0.0625));
  CHECK(integral(density) == doctest::Approx(1));

  const QuadTree two_peaks = peaked({0.3f, 0.7f});
  const std::vector<QuadNode> before = two_peaks.density(LeafMass::sum),
                              after = two_peaks.smoothed(0).density(LeafMass::sum),
                              even = two_peaks.smoothed(1e12).density(LeafMass::sum);
  RandomStream random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = random.next_2d();
    CHECK(QuadDensity(after).at(p) == doctest::Approx(QuadDensity(before).at(p)));
    CHECK(QuadDensity(even).at(p) == doctest::Approx(1));
  }
}

TEST_CASE("scaling a tree keeps its density") {
  QuadTree tree = peaked({0.3f, 0.7f});
  const std::vector<QuadNode> before = tree.density(LeafMass::sum);
  const double total = tree.total();
  tree.scale(0.25);
  CHECK(tree.total() == doctest::Approx(0.25 * total));
  const std::vector<QuadNode> after = tree.density(LeafMass::sum);
  for (const Vec2 p : {Vec2{0.3f, 0.7f}, {0.1f, 0.1f}, {0.99f, 0.5f}}) {
    CHECK(QuadDensity(after).at(p) == doctest::Approx(QuadDensity(before).at(p)));
  }
}

TEST_CASE("the box filter keeps what it spreads, over the seam and over the poles") {
  RandomStream random(5);
  const QuadTree start = peaked({0.999f, 0.001f});
  for (int i = 0; i < 2000; ++i) {
    QuadTree tree = start.refined(LeafMass::sum, {});
    Vec2 p = random.next_2d();
    if (i % 3 == 0) p.x = random.next_1d() < 0.5f ? 0.0f : std::nextafter(1.0f, 0.0f);
    if (i % 5 == 0) p.y = random.next_1d() < 0.5f ? 0.0f : std::nextafter(1.0f, 0.0f);
    tree.spread(p, 2.5);
    CHECK(tree.total() == doctest::Approx(2.5).epsilon(1e-12));
  }
}

TEST_CASE("a box goes on at the other edge of the seam, and half a turn further at a pole") {
  const QuadRefinement rule{.threshold = 0.2};  // 4 x 4 leaves
  const auto share_at = [&](Vec2 center, Vec2 p) {
    QuadTree tree(rule);
    tree.spread(center, 1);
    const std::vector<QuadNode> nodes = tree.density(LeafMass::sum);
    return double{QuadDensity(nodes).at(p)} / 16;
  };
  // The center is on the seam, in the middle of a leaf's edge: half of the box is on either side.
  CHECK(share_at({0.375f, 0}, {0.375f, 0.1f}) == doctest::Approx(0.5));
  CHECK(share_at({0.375f, 0}, {0.375f, 0.9f}) == doctest::Approx(0.5));
  // The center is on a pole: one half stays, the other half is opposite.
  CHECK(share_at({0, 0.125f}, {0.1f, 0.125f}) == doctest::Approx(0.5));
  CHECK(share_at({0, 0.125f}, {0.1f, 0.625f}) == doctest::Approx(0.5));
  const float one = std::nextafter(1.0f, 0.0f);
  CHECK(share_at({one, 0.875f}, {0.9f, 0.875f}) == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(share_at({one, 0.875f}, {0.9f, 0.375f}) == doctest::Approx(0.5).epsilon(1e-5));
  // The box is equal to a leaf.
  CHECK(share_at({0.375f, 0.375f}, {0.3f, 0.3f}) == doctest::Approx(1));
}

TEST_CASE("what is drawn has the density, on the square and on the sphere") {
  for (const LeafMass kind : {LeafMass::sum, LeafMass::root}) {
    const std::vector<QuadNode> nodes = peaked({0.98f, 0.01f}, kind).density(kind);
    const QuadDensity density(nodes);
    RandomStream random(7);
    constexpr int kCells = 16, kDraws = 200'000;
    std::vector<double> observed(kCells * kCells), expected(kCells * kCells);
    const auto cell_of = [](Vec2 p) {
      return static_cast<std::size_t>(p.y * kCells) * kCells +
             static_cast<std::size_t>(p.x * kCells);
    };
    for (int i = 0; i < kDraws; ++i) {
      const Vec3 direction = warp::sphere_from_square(density.sample(random.next_2d()));
      ++observed[cell_of(warp::square_from_sphere(direction))];
    }
    constexpr int kFine = 1024;
    for (int y = 0; y < kFine; ++y) {
      for (int x = 0; x < kFine; ++x) {
        const Vec2 p{(static_cast<float>(x) + 0.5f) / kFine,
                     (static_cast<float>(y) + 0.5f) / kFine};
        expected[cell_of(p)] += density.at(p) * kDraws / (double{kFine} * kFine);
      }
    }
    CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-4);
  }
}

TEST_CASE("warping keeps points in their leaf and in order") {
  const std::vector<QuadNode> nodes = peaked({0.3f, 0.7f}).density(LeafMass::sum);
  const QuadDensity density(nodes);
  const float one = std::nextafter(1.0f, 0.0f);
  for (const Vec2 u : {Vec2{0, 0}, {one, one}, {0, one}, {one, 0}, {0.5f, 0.5f}}) {
    const Vec2 p = density.sample(u);
    CHECK(p.x >= 0);
    CHECK(p.x < 1);
    CHECK(p.y >= 0);
    CHECK(p.y < 1);
    CHECK(density.at(p) > 0);
  }
  CHECK(density.sample({0.2f, 0.4f}).x < density.sample({0.4f, 0.4f}).x);
}

/// A tree with its density: what is saved of a cell.
struct TreeAndDensity {
  QuadTree tree;
  std::vector<QuadNode> nodes;
  void archive(Archive& archive) {
    archive(tree, nodes);
    archive.expect(is_density(nodes), "the density");
  }
};

TreeAndDensity loaded(const std::string& text) {
  std::istringstream in(text);
  TreeAndDensity both{QuadTree(QuadRefinement{}), {}};
  load(in, both);
  return both;
}

TEST_CASE("only trees in their order, with shares, are densities") {
  const std::vector<QuadNode> good{{.children = 1 << 4 | 0b1001}, {.left = 0}, {.left = 1}};
  CHECK(is_density(good));
  CHECK(integral(QuadDensity(good), 64) == doctest::Approx(1));
  const auto changed = [&](std::size_t i, QuadNode node) {
    std::vector<QuadNode> nodes = good;
    nodes[i] = node;
    return nodes;
  };
  CHECK_FALSE(is_density(changed(1, {.left = -0.1f})));
  CHECK_FALSE(is_density(changed(1, {.left = std::numeric_limits<float>::quiet_NaN()})));
  CHECK_FALSE(is_density(changed(2, {.lower = {0, 1.5f}})));
  CHECK_FALSE(is_density(changed(0, {.children = 1 << 4 | 0b0001})));  // nothing leads to the last
  CHECK_FALSE(is_density(changed(0, {.children = 2 << 4 | 0b1001})));
  CHECK_FALSE(is_density(changed(0, {.children = 1 << 4 | 0b1011})));  // there is no third child
  CHECK_FALSE(is_density(changed(2, {.children = 1 << 4 | 0b0001})));  // a loop
}

TEST_CASE("trees and densities survive being saved; damage is found") {
  const QuadTree tree = peaked({0.3f, 0.7f});
  const std::string file = saved(TreeAndDensity{tree, tree.density(LeafMass::sum)});
  const TreeAndDensity same = loaded(file);
  CHECK(saved(same) == file);
  CHECK(same.tree.node_count() == tree.node_count());
  CHECK(same.tree.total() == tree.total());
  const std::vector<QuadNode> nodes = tree.density(LeafMass::sum);
  CHECK(QuadDensity(same.nodes).at({0.3f, 0.7f}) == QuadDensity(nodes).at({0.3f, 0.7f}));
  RandomStream random(1);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = file;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    try {
      const TreeAndDensity read = loaded(damaged);
      CHECK(integral(QuadDensity(read.nodes)) == doctest::Approx(1).epsilon(0.01));
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 50);
}

}  // namespace
}  // namespace pharos::practical_path_guiding

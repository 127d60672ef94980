#include <cmath>
#include <sstream>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/guiding/toolkit/kd_tree.h>
#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

Bounds3 cube() {
  Bounds3 box;
  box.add(Point3{-1, -1, -1});
  box.add(Point3{2, 2, 2});
  return box;
}

/// Returns a tree of `cells` cells. Random cells are divided in their middle, which is where a grid
/// over the cube has edges, or elsewhere.
KdTree random_tree(std::uint32_t cells, bool in_the_middle, std::uint64_t seed) {
  KdTree tree;
  std::vector<Bounds3> boxes{cube()};
  RandomStream random(seed);
  while (tree.cell_count() < cells) {
    const auto cell =
        static_cast<std::uint32_t>(random.next_1d() * static_cast<float>(tree.cell_count()));
    const std::uint32_t leaf = tree.leaves()[cell];
    const int axis = tree.levels()[leaf] % 3;
    Bounds3& box = boxes[cell];
    const float where = in_the_middle ? 0.5f : random.next_1d();
    const float plane = in_the_middle ? 0.5f * (box.low[axis] + box.high[axis])
                                      : std::lerp(box.low[axis], box.high[axis], where);
    tree.divide(leaf, axis, plane);
    Bounds3 upper = box;
    box.high[axis] = upper.low[axis] = plane;
    boxes.push_back(upper);
  }
  return tree;
}

/// Returns points in the cube and around it; some of their coordinates are on planes of the trees,
/// next to them, or infinite.
std::vector<Point3> points() {
  std::vector<Point3> points;
  RandomStream random(5);
  for (int i = 0; i < 20000; ++i) {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const float anywhere = 5 * random.next_1d() - 2;
      const float on_edge = -1 + 3 * std::floor(64 * random.next_1d()) / 64;
      const float kind = random.next_1d();
      p[axis] = kind < 0.6f    ? anywhere
                : kind < 0.7f  ? on_edge
                : kind < 0.8f  ? std::nextafter(on_edge, kInfinity)
                : kind < 0.9f  ? std::nextafter(on_edge, -kInfinity)
                : kind < 0.95f ? kInfinity
                               : -kInfinity;
    }
    points.push_back(p);
  }
  return points;
}

int differences(const KdTree& a, const KdTree& b) {
  int count = 0;
  for (const Point3 p : points()) count += a.cell_at(p) != b.cell_at(p) ? 1 : 0;
  return count;
}

TEST_CASE("an index over any box changes no cell of a kd-tree") {
  for (const bool in_the_middle : {true, false}) {
    for (const std::uint32_t cells : {1u, 63u, 64u, 700u, 3000u}) {
      CAPTURE(in_the_middle);
      CAPTURE(cells);
      const KdTree tree = random_tree(cells, in_the_middle, cells);
      for (const Bounds3 box : {cube(), Bounds3{{-1, -1, -1}, {0, 1.5f, 0.1f}},
                                Bounds3{{1.99f, 1.99f, -9}, {7, 8, 9}}}) {
        KdTree indexed = tree;
        indexed.index(box);
        CHECK((indexed.size_bytes() > tree.size_bytes()) == (cells >= 64));
        CHECK(indexed == tree);
        CHECK(differences(indexed, tree) == 0);
      }
    }
  }
}

TEST_CASE("boxes without a volume, and those that floats cannot divide, make no index") {
  const KdTree tree = random_tree(100, true, 1);
  const Bounds3 narrow{{0, 0, 1e6f}, {1, 1, 1e6f + 1}};  // few floats lie between its ends
  for (const Bounds3 box :
       {Bounds3{}, narrow, Bounds3{{0, 0, 0}, {1, 1, 0}}, Bounds3{{0, 0, 0}, {1, 1, kInfinity}},
        Bounds3{{0, 0, 0}, {1, 1, std::nanf("")}}}) {
    KdTree indexed = tree;
    indexed.index(box);
    CHECK(indexed.size_bytes() == tree.size_bytes());
    CHECK(differences(indexed, tree) == 0);
  }
}

TEST_CASE("an index is saved with its tree, and a division drops it") {
  KdTree tree = random_tree(200, false, 2);
  const std::size_t bytes = tree.size_bytes();
  tree.index(cube());
  KdTree copy;
  std::istringstream in(test::saved(tree));
  load(in, copy);
  CHECK(copy.size_bytes() == tree.size_bytes());
  CHECK(differences(copy, tree) == 0);
  CHECK(tree.upper_part(std::vector<bool>(399, true)).tree.size_bytes() == tree.size_bytes());

  KdTree divided_before;
  std::istringstream again(test::saved(random_tree(200, false, 2)));
  load(again, divided_before);
  for (KdTree* const each : {&tree, &divided_before}) each->divide(each->leaves()[0], 0, -1.5f);
  CHECK(tree.size_bytes() < bytes + 100);
  CHECK(differences(tree, divided_before) == 0);
  CHECK(differences(tree, copy) > 0);
}

}  // namespace
}  // namespace pharos

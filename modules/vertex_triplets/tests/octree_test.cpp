#include "../octree.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>

namespace pharos::vertex_triplets {
namespace {

const Cube kCube{{1, -2, 3}, 4};

Point3 point_in(const Cube& cube, RandomStream& random) {
  const Vec2 xy = random.next_2d();
  return cube.center + cube.size * Vec3{xy.x - 0.5f, xy.y - 0.5f, random.next_1d() - 0.5f};
}

bool contains(const Cube& cube, Point3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(p[axis] - cube.center[axis]) > 0.5f * cube.size) return false;
  }
  return true;
}

/// Returns the counts of points that are concentrated in one corner.
std::vector<double> crowd(const Octree& tree, int count) {
  std::vector<double> counts(tree.cell_count(), 0);
  RandomStream random(5);
  for (int i = 0; i < count; ++i) {
    const Vec3 corner = kCube.center - 0.5f * kCube.size * Vec3{1, 1, 1};
    const float radius = kCube.size * std::pow(random.next_1d(), 3.0f);
    const Vec2 u = random.next_2d();
    ++counts[tree.cell_at(corner + radius * Vec3{u.x, u.y, random.next_1d()})];
  }
  return counts;
}

/// Returns a tree grown as the learner does it, with this threshold.
Octree grown(double threshold) {
  Octree tree(kCube);
  for (int i = 0; i < 6; ++i) {
    tree.divide(crowd(tree, 10000), threshold);
    tree.collapse(crowd(tree, 10000), threshold);
  }
  return tree;
}

TEST_CASE("octree: every point lies in the cube of its cell") {
  const Octree tree = grown(100);
  CHECK(tree.cell_count() > 50);
  CHECK(tree.depth() >= 3);
  RandomStream random(1);
  for (int i = 0; i < 10000; ++i) {
    const Point3 p = point_in(kCube, random);
    CHECK(contains(tree.cube(tree.cell_at(p)), p));
  }
  double volume = 0;
  for (std::uint32_t c = 0; c < tree.cell_count(); ++c) {
    CHECK(tree.cell_at(tree.cube(c).center) == c);
    volume += std::pow(tree.cube(c).size, 3);
  }
  CHECK(volume == doctest::Approx(std::pow(kCube.size, 3)));
  // A point outside of the cube belongs to the cell that is nearest along the axes.
  CHECK(tree.cell_at({-100, -100, -100}) == tree.cell_at({-1 + 1e-4f, -4 + 1e-4f, 1 + 1e-4f}));
}

TEST_CASE("octree: cells above the threshold are divided, cubes below it joined") {
  Octree tree(kCube);
  const std::vector<double> many{11};
  CHECK(tree.divide(many, 11).size() == 1);
  const Octree::Origins divided = tree.divide(many, 10);
  REQUIRE(divided.size() == 8);
  for (const auto& origin : divided) CHECK(origin == std::vector<std::uint32_t>{0});
  CHECK(tree.cell_count() == 8);
  std::vector<double> counts(8, 1);
  CHECK(tree.collapse(counts, 8).size() == 8);  // not below it
  const Octree::Origins joined = tree.collapse(counts, 8.5);
  REQUIRE(joined.size() == 1);
  CHECK(joined[0].size() == 8);
  CHECK(tree == Octree(kCube));
}

TEST_CASE("octree: about as many cells as there are thresholds in all samples") {
  const Octree tree = grown(10000.0 / 64);
  CHECK(tree.cell_count() > 32);
  CHECK(tree.cell_count() < 64 * 8);
  const std::vector<double> counts = crowd(tree, 10000);
  Octree again = tree;
  again.collapse(counts, 10000.0 / 64);
  CHECK(again == tree);  // no cube of several cells has too few points
}

TEST_CASE("octree: saved and loaded it is the same; damage is noticed") {
  const Octree tree = grown(200);
  std::ostringstream saved;
  save(saved, tree);
  const std::string bytes = saved.str();
  const auto loaded = [](const std::string& text) {
    std::istringstream in(text);
    Octree result(Cube{});
    load(in, result);
    return result;
  };
  CHECK(loaded(bytes) == tree);
  // The cuts are within the cube, within the number of nodes, and after the first node.
  for (const std::size_t length :
       {std::size_t{3}, std::size_t{21}, std::size_t{25}, bytes.size() - 1}) {
    CHECK_THROWS_AS(loaded(bytes.substr(0, length)), InputError);
  }
  std::string turned = bytes;
  turned.back() = 0;  // turns a cell into an inner node without parts
  CHECK_THROWS_AS(loaded(turned), InputError);
}

}  // namespace
}  // namespace pharos::vertex_triplets

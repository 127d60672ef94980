#include "../local_density.h"

#include <numeric>

#include <doctest/doctest.h>

#include "test_trees.h"

namespace pharos::focal {
namespace {

using namespace testing;

/// Returns the center of a voxel of the test box.
Point3 center_of(std::size_t voxel) {
  const Box box = test_box();
  constexpr std::size_t kEdge = std::size_t{1} << kVoxelLevel;
  Point3 center;
  for (int axis = 0; axis < 3; ++axis, voxel /= kEdge) {
    const double place = (static_cast<double>(voxel % kEdge) + 0.5) / kEdge;
    center[axis] = static_cast<float>(box.low[axis] + place * box.size[axis]);
  }
  return center;
}

/// The use of `count` equal segments that have added all of their mass to one voxel.
LocalUse use_of_voxel(std::size_t voxel, double count) {
  LocalUse use{VoxelMasses(kVoxels), VoxelMasses(kVoxels), count, count};
  use.converging[voxel] = 3;
  return use;
}

/// Returns an even density, half of it diverging, in cells of the size of voxels.
FocalDensity even_density() {
  const Octree half = refined(uniform_octree(test_box(), 0.5), {.threshold = 5e-4}).octree;
  return {half, half};
}

double mass(const FocalDensity& density) {
  return density.converging.mass() + density.diverging.mass();
}

}  // namespace

TEST_CASE("cell grid: points belong to the nearest cell, also outside of the box") {
  const CellGrid grid(test_box(), 3);
  CHECK(grid.count() == 27);
  CHECK(grid.at({-1.4f, 0.3f, 2.1f}) == 0);
  CHECK(grid.at({0, 0.3f, 2.1f}) == 1);
  CHECK(grid.at({-1.4f, 2.2f, 2.1f}) == 6);
  CHECK(grid.at({-1.4f, 0.3f, 6.4f}) == 18);
  CHECK(grid.at({-9, -9, -9}) == 0);
  CHECK(grid.at({9, 9, 9}) == 26);
}

TEST_CASE("voxels: cells of all sizes give their mass to the voxels that they cover") {
  for (const Octree& octree : {even_tree(), random_tree(5), pinhole_tree()}) {
    std::vector<double> masses(8 * octree.nodes().size());
    std::iota(masses.begin(), masses.end(), 1.0);
    double total = 0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (octree.nodes()[i / 8].is_leaf(i % 8)) total += masses[i];
    }
    VoxelMasses voxels;
    add_to_voxels(octree, masses, voxels);
    CHECK(std::accumulate(voxels.begin(), voxels.end(), 0.0) == doctest::Approx(total));
  }
}

TEST_CASE("voxels: weights multiply the density within them") {
  VoxelMasses weights(kVoxels, 1);
  CHECK(reweighted(random_tree(5), weights) == random_tree(5));
  // The cells of this tree are of the size of voxels.
  const Octree octree = refined(uniform_octree(test_box(), 1), {.threshold = 1e-3}).octree;
  for (std::size_t v = 0; v < kVoxels; ++v) weights[v] = static_cast<double>(v % 7);
  const Octree weighted = reweighted(octree, weights);
  for (std::size_t v = 0; v < kVoxels; v += 5) {
    CHECK(weighted.density(center_of(v)) ==
          doctest::Approx(weights[v] * octree.density(center_of(v))));
  }
  // A larger cell takes the mean weight of its voxels.
  const Octree root = uniform_octree(test_box(), 1).octree;
  for (std::size_t v = 0; v < kVoxels; ++v) weights[v] = center_of(v).x < 0 ? v % 3 : 5;
  double mean = 0;
  for (const double weight : weights) mean += weight / kVoxels;
  CHECK(reweighted(root, weights).mass() == doctest::Approx(mean));
  CHECK(reweighted(root, weights).density({1, 1, 3}) ==
        doctest::Approx(5 * root.density({1, 1, 3})));
}

TEST_CASE("local density: the density of the scene where nothing is known") {
  const FocalDensity whole = test_densities()[1].density;
  const FocalDensity local = local_density(whole, {}, 10);
  CHECK(local.converging == whole.converging);
  CHECK(local.diverging == whole.diverging);
}

TEST_CASE("local density: a mean of the density of the scene and of what segments use") {
  const FocalDensity whole = even_density();
  constexpr std::size_t kVoxel = 1234;
  const Point3 inside = center_of(kVoxel), outside = center_of(77);
  for (const double count : {5.0, 20.0, 1e6}) {
    CAPTURE(count);
    const FocalDensity local = local_density(whole, use_of_voxel(kVoxel, count), 20);
    CHECK(mass(local) == doctest::Approx(1).epsilon(1e-5));
    const double certainty = count / (count + 20);
    CHECK(local.at(outside) == doctest::Approx((1 - certainty) * whole.at(outside)));
    CHECK(local.converging.density(inside) ==
          doctest::Approx((certainty * kVoxels / 0.5 + 1 - certainty) *
                          whole.converging.density(inside)));
  }
}

TEST_CASE("local density: unequal segments count for fewer") {
  LocalUse use;
  const FocalDensity whole = even_density();
  std::vector<Segment> segments(10, Segment{.contribution = 1e-3f});
  segments[3].contribution = 1;
  use.add(segments, whole, FocalSums(whole));
  CHECK(use.segments() == doctest::Approx(1).epsilon(0.05));
}

}  // namespace pharos::focal

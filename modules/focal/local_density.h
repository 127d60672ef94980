#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <pharos/core/archive.h>

#include "focal_density.h"
#include "splat.h"

namespace pharos::focal {

/// A regular division of a box into cells.
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(const Box& box, int per_axis) : box_(box), per_axis_(per_axis) {}

  std::size_t count() const {
    const auto n = static_cast<std::size_t>(per_axis_);
    return n * n * n;
  }
  /// Returns the cell that is nearest to a point.
  std::size_t at(Point3 p) const;

 private:
  Box box_;
  int per_axis_ = 1;
};

/// Masses [1] in the voxels of a regular grid over the box of an octree, x fastest. Empty: zero.
using VoxelMasses = std::vector<double>;
/// The grid has 2^kVoxelLevel voxels along each axis.
constexpr unsigned kVoxelLevel = 4;
constexpr std::size_t kVoxels = std::size_t{1} << 3 * kVoxelLevel;

/// Adds the masses of an octree's leaves to the voxels that they cover: `masses[8 i + c]` for child
/// c of node i.
void add_to_voxels(const Octree& octree, std::span<const double> masses, VoxelMasses& voxels);

/// Returns an octree of the same cells, whose masses are multiplied by the weights of the voxels. A
/// leaf that covers several voxels takes their mean weight.
Octree reweighted(const Octree& octree, std::span<const double> weights);

/// The part of the focal density that segments use if they begin in one cell of space.
struct LocalUse {
  VoxelMasses converging, diverging;      ///< masses that the segments have added by narrowing
  double contributions = 0, squares = 0;  ///< sums over the segments

  /// Adds segments, and the masses that they have added to the cells of `density`.
  void add(std::span<const Segment> segments, const FocalDensity& density, const FocalSums& sums);
  LocalUse& operator+=(const LocalUse& other);
  /// Returns the effective number of segments (Kish 1965).
  double segments() const { return squares > 0 ? contributions * contributions / squares : 0; }
  void archive(Archive& archive);
};

/// Returns the density for segments that begin in one cell. The mass of each voxel is a mean of its
/// masses in `use` and in `density`, which counts for `prior` segments.
FocalDensity local_density(const FocalDensity& density, const LocalUse& use, double prior);

}  // namespace pharos::focal

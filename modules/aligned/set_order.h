#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "point_set.h"

/// The order in which the samples of a pixel visit a point set.
namespace pharos::aligned {

/// Sorts 2^b points into the leaves of a balanced kd-tree: the lower half in x before the upper
/// half, within each half the lower half in y before the upper half, and so on with alternating
/// axes. The first k bits of a point's index then identify its cell at level k.
void sort_into_cells(std::span<GridPoint> points);

/// Returns a number for each of 2^b points (b >= 1), as a fraction of 2^32. Points whose numbers
/// are below any limit are evenly spread along a direction [degrees]: the number is the point's
/// rank along it, with the bits in reverse order.
std::vector<std::uint32_t> spread_choices(std::span<const GridPoint> points, double direction);

/// The orders in which samples visit the sorted points of sets with 2^bits points.
class SetOrders {
 public:
  /// Prepares orders of 2^bits points, at most 2^16.
  explicit SetOrders(int bits);

  /// Returns the index of the point for sample `index`, modulo the number of points, in the order
  /// that `seed` selects. The order is a permutation in which every aligned run of 2^k samples has
  /// a point in each cell of level k, so parts of a set are spread evenly, too. Two orders assign
  /// different samples to the same cell, so dimensions stay independent of each other. The function
  /// applies a nested uniform scramble to the reversed index, with the hash of Laine and Karras
  /// (2011, "Stratified Sampling for Stochastic Transparency").
  std::uint32_t place(std::uint32_t index, std::uint32_t seed) const {
    // Each bit of the sums and products depends on lower bits only. The bits of a cell therefore
    // depend on the bits of the cells within it, which distinguish runs of samples.
    std::uint32_t v = reversed_[index & mask_] + seed;
    v ^= v * 0x6c50b47cu;
    v *= seed | 1;
    v ^= v * 0xb82f1e52u;
    return v >> shift_;
  }

 private:
  std::uint32_t mask_;
  int shift_;
  std::vector<std::uint32_t> reversed_;  ///< all bits of each index in reverse order
};

}  // namespace pharos::aligned

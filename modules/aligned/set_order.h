#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "point_set.h"

/// In which order the samples of a pixel visit a point set.
namespace pharos::aligned {

/// Sorts 2^b points into the leaves of a balanced kd-tree: the lower half in x before the upper
/// one, within each half the lower half in y, and so on in turn. The first k bits of a point's
/// place then tell its cell of the k-th level.
void sort_into_cells(std::span<GridPoint> points);

/// In which orders samples visit the places of sets of 2^bits sorted points.
class SetOrders {
 public:
  /// Of 2^bits points, at most 2^16.
  explicit SetOrders(int bits);

  /// The place of sample `index`, modulo the number of points, in the order that `seed` picks: a
  /// permutation in which every aligned run of 2^k samples has a point in each cell of level k, so
  /// that a part of a set is spread evenly too. Which samples meet in a cell differs from order to
  /// order: dimensions stay unrelated. A nested uniform scramble of the reversed index, hashed as
  /// by Laine and Karras (2011, "Stratified Sampling for Stochastic Transparency").
  std::uint32_t place(std::uint32_t index, std::uint32_t seed) const {
    // Each bit of the sums and products depends on lower bits alone: a cell's on those of cells
    // within it, which tell runs of samples apart.
    std::uint32_t v = reversed_[index & mask_] + seed;
    v ^= v * 0x6c50b47cu;
    v *= seed | 1;
    v ^= v * 0xb82f1e52u;
    return v >> shift_;
  }

 private:
  std::uint32_t mask_;
  int shift_;
  std::vector<std::uint32_t> reversed_;  ///< all bits of an index, the last one first
};

}  // namespace pharos::aligned

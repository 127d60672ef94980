#pragma once

#include <cstdint>
#include <span>

#include "point_set.h"

/// In which order the samples of a pixel visit a point set.
namespace pharos::aligned {

/// Sorts 2^b points into the leaves of a balanced kd-tree: the lower half in x before the upper
/// one, within each half the lower half in y, and so on in turn. The first k bits of a point's
/// place then tell its cell of the k-th level.
void sort_into_cells(std::span<GridPoint> points);

/// The bits of a word, the last one first.
constexpr std::uint32_t reversed_bits(std::uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
}

/// The place of sample `index` in a set of 2^bits sorted points, in the order that `seed` picks: a
/// permutation in which every aligned run of 2^k samples has a point in each cell of level k, so
/// that a part of a set is spread evenly too. Which samples meet in a cell differs from order to
/// order: dimensions stay unrelated. A nested uniform scramble of the reversed index, hashed as by
/// Laine and Karras (2011, "Stratified Sampling for Stochastic Transparency").
constexpr std::uint32_t place_in_set(std::uint32_t index, int bits, std::uint32_t seed) {
  // Each bit of the sums and products depends on lower bits alone: a cell's on those of cells
  // within it, which tell runs of samples apart.
  std::uint32_t v = reversed_bits(index) + seed;
  v ^= v * 0x6c50b47cu;
  v *= seed | 1;
  v ^= v * 0xb82f1e52u;
  return v >> (32 - bits);
}

}  // namespace pharos::aligned

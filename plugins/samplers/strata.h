#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pharos/core/random.h>

#include "keyed_seeds.h"

/// Grids of strata and hashed permutations of them.
namespace pharos {

/// Columns and rows of a grid of strata over the unit square, 2^16 cells at most.
struct StrataGrid {
  std::uint32_t columns, rows;
  constexpr std::uint32_t cells() const { return columns * rows; }
};

/// Rows and columns of the cells of a grid, which are numbered row by row.
class GridCells {
 public:
  constexpr explicit GridCells(StrataGrid grid)
      : columns_(grid.columns), reciprocal_((std::uint64_t{1} << 32) / grid.columns + 1) {}

  struct Cell {
    std::uint32_t column, row;
  };
  /// A product with the reciprocal, rounded up, is exact for numbers as small as these.
  constexpr Cell operator[](std::uint32_t number) const {
    const auto row = static_cast<std::uint32_t>((number * reciprocal_) >> 32);
    return {number - row * columns_, row};
  }

 private:
  std::uint32_t columns_;
  std::uint64_t reciprocal_;
};

/// The grid for sets of `samples`: exactly as many cells where that is a product of two numbers
/// that are no more than a factor of four apart, otherwise the nearly square grid with the fewest
/// cells to spare. A square has as many columns as rows; otherwise there are more rows.
constexpr StrataGrid grid_of(std::uint32_t samples) {
  std::uint32_t root = 1;
  while ((root + 1) * (root + 1) <= samples) ++root;
  for (std::uint32_t columns = root; 2 * columns >= root; --columns) {
    if (samples % columns == 0 && samples <= 4 * columns * columns) {
      return {columns, samples / columns};
    }
  }
  return {root, (samples + root - 1) / root};
}

/// The image of `index` under a permutation of the numbers below `count` that `seed` picks. A
/// bijection of the numbers with as many bits is walked until it leads below `count` (the idea of
/// Kensler 2013, "Correlated Multi-Jittered Sampling"), then all are rotated, which makes every
/// image of an index exactly as likely.
constexpr std::uint32_t permuted(std::uint32_t index, std::uint32_t count, std::uint32_t seed) {
  const auto bits = static_cast<std::uint32_t>(std::bit_width(count - 1));
  const std::uint32_t mask = (std::uint32_t{1} << bits) - 1, shift = (bits + 1) / 2;
  const std::uint32_t mixed = seed * 0x2c1b3c6du;
  do {
    // Each step (an exclusive or, a product with an odd number, a shift onto itself) is a
    // bijection.
    index = ((index ^ (mixed >> 16)) * ((mixed >> 8) | 1)) & mask;
    index ^= index >> shift;
    index = ((index ^ (mixed >> 20)) * ((mixed >> 11) | 1)) & mask;
    index ^= index >> shift;
    index = ((index ^ (mixed >> 4)) * ((mixed >> 14) | 1)) & mask;
    index ^= index >> shift;
  } while (index >= count);
  index += static_cast<std::uint32_t>((std::uint64_t{seed} * count) >> 32);
  return index < count ? index : index - count;
}

/// Permutations as those of permuted(), for small counts: faster, from tables.
class DrawnPermutations {
 public:
  explicit DrawnPermutations(std::uint32_t count) : count_(count) {
    for (std::uint32_t table = 0; table < kTables; ++table) {
      const std::size_t first = images_.size();
      for (std::uint32_t i = 0; i < count; ++i) images_.push_back(static_cast<std::uint16_t>(i));
      RandomStream random(count, table);
      for (std::uint32_t i = count; i-- > 1;) {
        std::swap(images_[first + i], images_[first + random() % (i + 1)]);
      }
    }
  }

  /// The image of `index` under the permutation that `seed` picks: one of the tables, rotated.
  std::uint32_t operator()(std::uint32_t index, std::uint32_t seed) const {
    const std::uint64_t scaled = std::uint64_t{seed} * count_;
    const auto table = static_cast<std::uint32_t>(scaled) >> (32 - kTableBits);
    const std::uint32_t image =
        images_[table * count_ + index] + static_cast<std::uint32_t>(scaled >> 32);
    return image < count_ ? image : image - count_;
  }

 private:
  static constexpr int kTableBits = 6;
  static constexpr std::uint32_t kTables = 1u << kTableBits;

  std::uint32_t count_;
  std::vector<std::uint16_t> images_;
};

/// Two unrelated fractions of 32 bits for a sample of a set: its jitter.
constexpr std::uint64_t jitter_bits(std::uint32_t index, const Seeds& seeds) {
  return mix_bits((std::uint64_t{seeds.more} << 32) + index * 0x9e3779b97f4a7c15ull + seeds.x);
}

/// Equal strata of [0, 1) whose numbers never leave them by rounding.
class Strata {
 public:
  /// At most 3^12 of them.
  constexpr explicit Strata(std::uint32_t count) : width_((std::uint64_t{1} << 63) / count) {}

  /// The number at `offset`, a fraction of 32 bits, within a stratum: one of the multiples of 2^-24
  /// that lie in it.
  constexpr float at(std::uint32_t stratum, std::uint32_t offset) const {
    const std::uint32_t first = first_of(stratum), count = first_of(stratum + 1) - first;
    const auto steps = static_cast<std::int32_t>(first + ((std::uint64_t{offset} * count) >> 32));
    return static_cast<float>(steps) * 0x1p-24f;
  }

 private:
  /// The stratum's begin in steps of 2^-24, rounded up. Begins that are no whole steps keep 1.8e-6
  /// of a step away from these; the product is too small by 0.95e-6 at most.
  constexpr std::uint32_t first_of(std::uint32_t stratum) const {
    constexpr std::uint64_t kStep = std::uint64_t{1} << 39, kSlack = std::uint64_t{1} << 18;
    return static_cast<std::uint32_t>((stratum * width_ + (kStep - kSlack)) >> 39);
  }

  std::uint64_t width_;
};

/// Number `index` of a set of `count` stratified numbers: each in a stratum of its own, in an order
/// that the seeds pick.
inline float stratified_number(std::uint32_t index, std::uint32_t count, const Strata& strata,
                               const Seeds& seeds) {
  const auto jitter = static_cast<std::uint32_t>(jitter_bits(index, seeds) >> 32);
  return strata.at(permuted(index, count, seeds.order), jitter);
}

}  // namespace pharos

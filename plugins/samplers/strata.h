#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <pharos/core/random.h>

#include "keyed_seeds.h"

/// Grids of strata and permutations of them.
namespace pharos {

/// A grid of strata over the unit square, with at most 2^16 cells.
struct StrataGrid {
  std::uint32_t columns, rows;
  constexpr std::uint32_t cells() const { return columns * rows; }
};

/// Maps the number of a cell to its row and column; cells are numbered row by row.
class GridCells {
 public:
  constexpr explicit GridCells(StrataGrid grid)
      : columns_(grid.columns), reciprocal_((std::uint64_t{1} << 32) / grid.columns + 1) {}

  struct Cell {
    std::uint32_t column, row;
  };
  /// Multiplies by the reciprocal, rounded up. The quotient is exact for numbers as small as these.
  constexpr Cell operator[](std::uint32_t number) const {
    const auto row = static_cast<std::uint32_t>((number * reciprocal_) >> 32);
    return {number - row * columns_, row};
  }

 private:
  std::uint32_t columns_;
  std::uint64_t reciprocal_;
};

/// Returns the grid for sets of `samples`. It has exactly as many cells if that number is a product
/// of two factors that differ by a factor of four at most. Otherwise it is the nearly square grid
/// with the fewest spare cells. Grids that are not square have more rows than columns.
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

/// Permutations of the numbers below a count, made of tables. A 32-bit word selects the
/// permutation.
class DrawnPermutations {
 public:
  /// Permutes the numbers below `count`, 1 to 2^16. `seed` draws the tables. Small counts get many
  /// tables, because each table has only few rotations.
  DrawnPermutations(std::uint32_t count, std::uint64_t seed) : count_(count) {
    const int index_bits = static_cast<int>(std::bit_width(count - 1));
    const int table_bits = std::clamp(12 - index_bits, 0, 8);
    shift_ = 32 - table_bits - index_bits;
    tables_ = ((1u << table_bits) - 1) << index_bits;
    images_.resize(std::size_t{1} << (table_bits + index_bits));
    RandomStream random(seed, count);
    for (std::uint32_t table = 0; table < (1u << table_bits); ++table) {
      const std::span<std::uint16_t> images(&images_[table << index_bits], count);
      std::iota(images.begin(), images.end(), std::uint16_t{0});
      for (std::uint32_t i = count; i-- > 1;) std::swap(images[i], images[random() % (i + 1)]);
    }
  }

  /// Returns the image of `index` under the permutation that `seed` selects: two tables, one after
  /// the other, with rotations before, between and after them. The last rotation makes every image
  /// of an index exactly equally likely. All rotations together make all pairs of images of two
  /// indices nearly equally likely (within a fraction of a percent).
  std::uint32_t operator()(std::uint32_t index, std::uint32_t seed) const {
    const std::uint64_t last = std::uint64_t{seed} * count_;
    const std::uint64_t others = static_cast<std::uint32_t>(last) * 0x9e3779b97f4a7c15ull;
    const std::uint64_t first = (others >> 32) * count_;
    const std::uint64_t second = static_cast<std::uint32_t>(others) * std::uint64_t{count_};
    const std::uint32_t middle = image(rotated(index, first), first);
    return rotated(image(rotated(middle, second), second), last);
  }

  /// A faster variant with one table and rotations before and after it. Pairs of images of two
  /// indices are equally likely within about 10%, and exactly over the seeds of the tables.
  std::uint32_t through_one(std::uint32_t index, std::uint32_t seed) const {
    const std::uint64_t last = std::uint64_t{seed} * count_;
    const std::uint64_t first = static_cast<std::uint32_t>(last) * std::uint64_t{count_};
    return rotated(image(rotated(index, first), first), last);
  }

 private:
  /// Returns the image of `index` in the table that the lower half of `choice` selects.
  std::uint32_t image(std::uint32_t index, std::uint64_t choice) const {
    return images_[((static_cast<std::uint32_t>(choice) >> shift_) & tables_) + index];
  }
  /// Rotates `index` by the upper half of `choice`, a number below the count.
  std::uint32_t rotated(std::uint32_t index, std::uint64_t choice) const {
    index += static_cast<std::uint32_t>(choice >> 32);
    return index < count_ ? index : index - count_;
  }

  std::uint32_t count_;
  int shift_;
  std::uint32_t tables_;               ///< bits of a place in images_ that select a table
  std::vector<std::uint16_t> images_;  ///< the images of all tables, each padded to a power of two
};

/// Returns two unrelated 32-bit fractions, the jitter of a sample of a set.
constexpr std::uint64_t jitter_bits(std::uint32_t index, const Seeds& seeds) {
  return mix_sum((std::uint64_t{seeds.more} << 32) + index * 0x9e3779b97f4a7c15ull + seeds.x);
}

/// Equal strata of [0, 1). Rounding never moves a number out of its stratum.
class Strata {
 public:
  /// Divides [0, 1) into `count` strata, at most 3^12.
  constexpr explicit Strata(std::uint32_t count) : width_((std::uint64_t{1} << 63) / count) {}

  /// Returns the number at `offset`, a 32-bit fraction, within a stratum. The number is one of the
  /// multiples of 2^-24 in the stratum.
  constexpr float at(std::uint32_t stratum, std::uint32_t offset) const {
    // The begin and end of the stratum in steps of 2^-24, rounded up. A begin or end that is not a
    // whole step is at least 1.8e-6 of a step away from one; the product is too small by at most
    // 0.95e-6 of a step.
    constexpr std::uint64_t kStep = std::uint64_t{1} << 39, kSlack = std::uint64_t{1} << 18;
    const std::uint64_t begin = stratum * width_ + (kStep - kSlack);
    const std::uint64_t first = begin >> 39, count = ((begin + width_) >> 39) - first;
    const auto steps = static_cast<std::int32_t>(first + ((offset * count) >> 32));
    return static_cast<float>(steps) * 0x1p-24f;
  }

 private:
  std::uint64_t width_;
};

/// Returns number `index` of a set of stratified numbers. Each number lies in its own stratum; the
/// seeds select the order of the strata.
inline float stratified_number(std::uint32_t index, const DrawnPermutations& orders,
                               const Strata& strata, const Seeds& seeds) {
  const auto jitter = static_cast<std::uint32_t>(jitter_bits(index, seeds) >> 32);
  return strata.at(orders(index, seeds.order), jitter);
}

}  // namespace pharos

#pragma once

#include <bit>
#include <cstdint>

#include <pharos/core/random.h>

#include "keyed_seeds.h"

/// Grids of strata and hashed permutations of them.
namespace pharos {

/// Columns and rows of a grid of strata over the unit square.
struct StrataGrid {
  std::uint32_t columns, rows;
  constexpr std::uint32_t cells() const { return columns * rows; }
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

/// Two unrelated fractions of 32 bits for a sample of a set: its jitter.
constexpr std::uint64_t jitter_bits(std::uint32_t index, const Seeds& seeds) {
  return mix_bits((std::uint64_t{seeds.more} << 32) + index * 0x9e3779b97f4a7c15ull + seeds.x);
}

/// Equal strata of [0, 1) whose numbers never leave them by rounding.
class Strata {
 public:
  /// At most 2^19 of them.
  constexpr explicit Strata(std::uint32_t count) : width_(0x1p24 / count) {}

  /// The number at `offset`, a fraction of 32 bits, within a stratum: one of the multiples of 2^-24
  /// that lie in it.
  constexpr float at(std::uint32_t stratum, std::uint32_t offset) const {
    const std::uint32_t first = first_of(stratum), count = first_of(stratum + 1) - first;
    return static_cast<float>(first + ((std::uint64_t{offset} * count) >> 32)) * 0x1p-24f;
  }

 private:
  /// Rounds up. The multiples of `width_` that are no integers keep farther from them than 2^-20,
  /// which the product's error does not reach.
  constexpr std::uint32_t first_of(std::uint32_t stratum) const {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(stratum * width_ + (1 - 0x1p-20)));
  }

  double width_;
};

/// Number `index` of a set of `count` stratified numbers: each in a stratum of its own, in an order
/// that the seeds pick.
inline float stratified_number(std::uint32_t index, std::uint32_t count, const Strata& strata,
                               const Seeds& seeds) {
  const auto jitter = static_cast<std::uint32_t>(jitter_bits(index, seeds) >> 32);
  return strata.at(permuted(index, count, seeds.order), jitter);
}

}  // namespace pharos

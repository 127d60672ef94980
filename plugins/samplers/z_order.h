#pragma once

#include <cstdint>

#include "keyed_seeds.h"

/// Z-order curves in which the four children of each node come in a random order.
namespace pharos::z_order {

/// Inserts a zero above each of the 32 bits.
constexpr std::uint64_t spread(std::uint64_t v) {
  v = (v | (v << 16)) & 0x0000ffff0000ffffull;
  v = (v | (v << 8)) & 0x00ff00ff00ff00ffull;
  v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0full;
  v = (v | (v << 2)) & 0x3333333333333333ull;
  return (v | (v << 1)) & 0x5555555555555555ull;
}

/// Chooses, at each node, which bit of a base-4 digit separates the pairs of children. It is the
/// bit of y for a quarter of the nodes, the bit of x for another quarter, and the sum of both
/// modulo 2 for the others. In `reversed`, a place whose lowest bit belongs to its first digit, the
/// bit of y comes first, at the even places. Only digits whose even places are in `digits` are
/// changed.
constexpr std::uint32_t with_pairings(std::uint32_t reversed, const Seeds& seeds,
                                      std::uint32_t digits) {
  // Products with odd numbers carry upwards only. Once the own bit of an even place is removed from
  // the product, the bit there depends on the digits before it alone. A seed makes the two choices
  // of a level independent; the low bits of the factor make the choices of different nodes
  // independent.
  const std::uint32_t product = (reversed + seeds.x) * ((seeds.order << 1) | 1);
  const std::uint32_t a = product ^ (product * 0x05526c56u) ^ reversed;
  const std::uint32_t b = ((product ^ seeds.more) * 0x9e3779bfu) ^ reversed;
  const std::uint32_t differ = (reversed ^ (reversed >> 1)) & a & digits;
  const std::uint32_t swapped = reversed ^ differ ^ (differ << 1);
  return swapped ^ ((swapped >> 1) & b & digits);
}

}  // namespace pharos::z_order

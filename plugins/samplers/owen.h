#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include <pharos/core/random.h>

/// The first two Sobol' dimensions, a (0,2)-sequence in base 2, with hashed Owen scrambling.
/// Numbers are 32-bit fractions. `reversed` marks bit-reversed ones, whose lowest bit is the first
/// digit: scrambling and generating are cheap there.
namespace pharos::owen {

template <class Word>
constexpr Word reverse_bits(Word v) {
  v = (v >> 16) | (v << 16);
  v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
}

/// A nested uniform scramble of a reversed fraction, chosen by `seed`: every digit is flipped or
/// not by the digits before it. The form is that of Laine and Karras (2011, "Stratified Sampling
/// for Stochastic Transparency"), with the constants of Vegdahl (2021, "Building a Better LK
/// Hash").
template <class Word>
constexpr Word scramble_reversed(Word v, Word seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

/// A permutation of indices that maps the first 2^k of them, for every k, to an aligned block of
/// 2^k: each such block of a (0,2)-sequence is a net, so its prefixes stay stratified.
constexpr std::uint32_t shuffle_index(std::uint32_t index, std::uint32_t seed) {
  return reverse_bits(scramble_reversed(reverse_bits(index), seed));
}

/// Reversed value of the second Sobol' dimension (that of the first is the index itself). Its
/// matrix is Pascal's triangle modulo 2; digit k is the sum of those digits j of the index whose
/// position contains k as a set of bits (Lucas), which five butterfly steps add up.
constexpr std::uint32_t sobol_y_reversed(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 16) & 0x0000ffffu;
  return index;
}

/// The number in [0, 1) whose reversed fraction is the scramble of `reversed` that `seed` picks.
constexpr float scrambled_number(std::uint32_t reversed, std::uint32_t seed) {
  return to_unit_float(reverse_bits(scramble_reversed(reversed, seed)));
}

/// Two of them, computed side by side.
inline Vec2 scrambled_point(std::uint64_t reversed, std::uint64_t seeds) {
  using Pair = std::uint64_t __attribute__((vector_size(16)));
  using Words = std::uint32_t __attribute__((vector_size(16)));
  const auto words = [](std::uint64_t pair) { return std::bit_cast<Words>(Pair{pair, 0}); };
  const Words steps = reverse_bits(scramble_reversed(words(reversed), words(seeds))) >> 8;
  return {static_cast<float>(static_cast<std::int32_t>(steps[0])) * 0x1p-24f,
          static_cast<float>(static_cast<std::int32_t>(steps[1])) * 0x1p-24f};
}

/// What each four bits of a reversed index add to its Sobol' point: the sum, modulo 2, is the
/// point, y above x, both reversed.
inline constexpr auto kSobolParts = [] {
  std::array<std::array<std::uint64_t, 16>, 8> parts{};
  for (std::uint32_t k = 0; k < 8; ++k) {
    for (std::uint32_t bits = 0; bits < 16; ++bits) {
      const std::uint32_t index = reverse_bits(bits << (4 * k));
      parts[k][bits] = (std::uint64_t{sobol_y_reversed(index)} << 32) | index;
    }
  }
  return parts;
}();

/// The Sobol' number of an index, scrambled.
constexpr float sobol_number(std::uint32_t reversed_index, std::uint32_t seed) {
  return scrambled_number(reverse_bits(reversed_index), seed);
}

/// The Sobol' point of an index, y above x, both reversed. From a table, as eight loads at once
/// take less time than the steps of reverse_bits() and sobol_y_reversed() one after the other.
constexpr std::uint64_t sobol_reversed(std::uint32_t reversed_index) {
  std::uint64_t sum = 0;
  for (std::uint32_t k = 0; k < 8; ++k) sum ^= kSobolParts[k][(reversed_index >> (4 * k)) & 15];
  return sum;
}

/// The Sobol' point of an index, scrambled.
inline Vec2 sobol_point(std::uint32_t reversed_index, std::uint32_t seed_x, std::uint32_t seed_y) {
  return scrambled_point(sobol_reversed(reversed_index), (std::uint64_t{seed_y} << 32) | seed_x);
}

}  // namespace pharos::owen

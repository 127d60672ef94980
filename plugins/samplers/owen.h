#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include <pharos/core/random.h>

/// The first four Sobol' dimensions, with hashed Owen scrambling. The first two are a
/// (0,2)-sequence in base 2.
/// Numbers are 32-bit fractions. `reversed` marks bit-reversed fractions, whose lowest bit is the
/// first digit. Scrambling and generating are cheap in this form.
namespace pharos::owen {

template <class Word>
constexpr Word reverse_bits(Word v) {
  v = (v >> 16) | (v << 16);
  v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
}

/// Applies the nested uniform scramble that `seed` selects to a reversed fraction: the digits
/// before a digit decide whether it is flipped. The form of the hash is due to Laine and Karras
/// (2011, "Stratified Sampling for Stochastic Transparency"), its constants to Vegdahl (2021,
/// "Building a Better LK Hash").
template <class Word>
constexpr Word scramble_reversed(Word v, Word seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

/// Permutes indices so that for every k the first 2^k indices map to an aligned block of 2^k. Each
/// such block of a (0,2)-sequence is a net, so prefixes of the sequence remain stratified.
constexpr std::uint32_t shuffle_index(std::uint32_t index, std::uint32_t seed) {
  return reverse_bits(scramble_reversed(reverse_bits(index), seed));
}

/// Returns the reversed value of the second Sobol' dimension. (The reversed value of the first
/// dimension is the index itself.) The generator matrix is Pascal's triangle modulo 2: digit k is
/// the sum of the digits j of the index whose position j contains k as a set of bits (Lucas). Five
/// butterfly steps compute the sum.
constexpr std::uint32_t sobol_y_reversed(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 16) & 0x0000ffffu;
  return index;
}

/// Returns the number in [0, 1) whose reversed fraction is `reversed`, scrambled by `seed`.
constexpr float scrambled_number(std::uint32_t reversed, std::uint32_t seed) {
  return to_unit_float(reverse_bits(scramble_reversed(reversed, seed)));
}

/// Computes two scrambled numbers side by side.
inline Vec2 scrambled_point(std::uint64_t reversed, std::uint64_t seeds) {
  using Pair = std::uint64_t __attribute__((vector_size(16)));
  using Words = std::uint32_t __attribute__((vector_size(16)));
  const auto words = [](std::uint64_t pair) { return std::bit_cast<Words>(Pair{pair, 0}); };
  const Words steps = reverse_bits(scramble_reversed(words(reversed), words(seeds))) >> 8;
  return {static_cast<float>(static_cast<std::int32_t>(steps[0])) * 0x1p-24f,
          static_cast<float>(static_cast<std::int32_t>(steps[1])) * 0x1p-24f};
}

/// Returns the reversed values of the third and fourth Sobol' dimension, the fourth in the upper
/// half. Their direction numbers follow from the primitive polynomials x^2 + x + 1 and x^3 + x + 1
/// with the first numbers 1, 3 and 1, 3, 1 of Joe and Kuo (2008, "Constructing Sobol' Sequences
/// with Better Two-Dimensional Projections").
constexpr std::uint64_t sobol_zw_reversed(std::uint32_t index) {
  std::array<std::uint32_t, 32> z{1, 3}, w{1, 3, 1};  // direction numbers as odd integers m_k
  std::uint64_t sum = 0;
  for (std::uint32_t k = 0; k < 32; ++k) {
    if (k >= 2) z[k] = (z[k - 1] << 1) ^ (z[k - 2] << 2) ^ z[k - 2];
    if (k >= 3) w[k] = (w[k - 2] << 2) ^ (w[k - 3] << 3) ^ w[k - 3];
    if ((index >> k & 1) == 0) continue;
    const auto reversed = [k](std::uint32_t m) { return reverse_bits(m << (31 - k)); };
    sum ^= (std::uint64_t{reversed(w[k])} << 32) | reversed(z[k]);
  }
  return sum;
}

/// The contribution of each four bits of a reversed index to a pair of Sobol' numbers.
using SobolParts = std::array<std::array<std::uint64_t, 16>, 8>;

/// Returns the contributions to what `pair` returns for an index. It must be linear modulo 2.
template <class Pair>
constexpr SobolParts sobol_parts(Pair&& pair) {
  SobolParts parts{};
  for (std::uint32_t k = 0; k < 8; ++k) {
    for (std::uint32_t bits = 0; bits < 16; ++bits) {
      parts[k][bits] = pair(reverse_bits(bits << (4 * k)));
    }
  }
  return parts;
}

/// The contributions to the first two dimensions (y above x) and to the next two (w above z).
inline constexpr SobolParts kSobolParts = sobol_parts(
    [](std::uint32_t index) { return (std::uint64_t{sobol_y_reversed(index)} << 32) | index; });
inline constexpr SobolParts kLaterSobolParts = sobol_parts(sobol_zw_reversed);

/// Returns the scrambled Sobol' number of an index.
constexpr float sobol_number(std::uint32_t reversed_index, std::uint32_t seed) {
  return scrambled_number(reverse_bits(reversed_index), seed);
}

/// Returns the pair of Sobol' numbers of an index, both reversed: by default y above x. It uses a
/// table, because eight independent loads take less time than the dependent steps of
/// reverse_bits() and sobol_y_reversed().
constexpr std::uint64_t sobol_reversed(std::uint32_t reversed_index,
                                       const SobolParts& parts = kSobolParts) {
  std::uint64_t sum = 0;
  for (std::uint32_t k = 0; k < 8; ++k) sum ^= parts[k][(reversed_index >> (4 * k)) & 15];
  return sum;
}

/// Returns the scrambled Sobol' point of an index.
inline Vec2 sobol_point(std::uint32_t reversed_index, std::uint32_t seed_x, std::uint32_t seed_y) {
  return scrambled_point(sobol_reversed(reversed_index), (std::uint64_t{seed_y} << 32) | seed_x);
}

}  // namespace pharos::owen

#pragma once

#include <cstdint>

#include <pharos/core/random.h>

/// The first two Sobol' dimensions, a (0,2)-sequence in base 2, with hashed Owen scrambling.
/// Numbers are 32-bit fractions. `reversed` marks bit-reversed ones, whose lowest bit is the first
/// digit: scrambling and generating are cheap there.
namespace pharos::owen {

constexpr std::uint32_t reverse_bits(std::uint32_t v) {
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
constexpr std::uint32_t scramble_reversed(std::uint32_t v, std::uint32_t seed) {
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

/// Reversed value of the first Sobol' dimension, van der Corput's sequence: the index itself.
constexpr std::uint32_t sobol_x_reversed(std::uint32_t index) {
  return index;
}

/// Reversed value of the second Sobol' dimension. Its matrix is Pascal's triangle modulo 2; digit k
/// is the sum of those digits j of the index whose position contains k as a set of bits (Lucas),
/// which five butterfly steps add up.
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

/// Two of them: their bits are reversed together, which takes the time of one.
constexpr Vec2 scrambled_point(std::uint32_t reversed_x, std::uint32_t seed_x,
                               std::uint32_t reversed_y, std::uint32_t seed_y) {
  std::uint64_t v = (std::uint64_t{scramble_reversed(reversed_y, seed_y)} << 32) |
                    scramble_reversed(reversed_x, seed_x);
  v = __builtin_bswap64(v);
  v = ((v >> 4) & 0x0f0f0f0f0f0f0f0full) | ((v & 0x0f0f0f0f0f0f0f0full) << 4);
  v = ((v >> 2) & 0x3333333333333333ull) | ((v & 0x3333333333333333ull) << 2);
  v = ((v >> 1) & 0x5555555555555555ull) | ((v & 0x5555555555555555ull) << 1);
  return to_unit_vec2(v);
}

}  // namespace pharos::owen

#pragma once

#include <cstdint>

#include <pharos/core/vec.h>

namespace pharos {

/// A bijective 64-bit mixer with full avalanche (Stafford's variant 13 of the MurmurHash3
/// finalizer, as used by SplitMix64).
constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ull;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebull;
  v ^= v >> 31;
  return v;
}

/// Adds one more word to a hash. The order of the words matters.
constexpr std::uint64_t hash_combine(std::uint64_t hash, std::uint64_t word) {
  return mix_bits(hash * 0x9e3779b97f4a7c15ull + word + 0x632be59bd9b4e019ull);
}

/// Maps the upper 24 of 32 random bits to [0, 1).
constexpr float to_unit_float(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}
/// Maps a 64-bit word to two independent numbers in [0, 1).
constexpr Vec2 to_unit_vec2(std::uint64_t bits) {
  return {to_unit_float(static_cast<std::uint32_t>(bits >> 32)),
          to_unit_float(static_cast<std::uint32_t>(bits))};
}

/// A counter-based random stream for learners and tests. Its values are a function of the key and
/// of the count of numbers drawn, never of a thread. The key names what the numbers are for, such
/// as (seed, iteration, leaf). Meets the requirements of UniformRandomBitGenerator. Paths use
/// SampleStream instead.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  constexpr explicit RandomStream(std::uint64_t seed, std::uint64_t a = 0, std::uint64_t b = 0,
                                  std::uint64_t c = 0)
      : state_(hash_combine(hash_combine(hash_combine(mix_bits(seed), a), b), c)) {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  constexpr result_type operator()() { return mix_bits(state_ += 0x9e3779b97f4a7c15ull); }

  /// Returns a uniform number in [0, 1) with 24 bits.
  constexpr float next_1d() { return to_unit_float(static_cast<std::uint32_t>((*this)() >> 32)); }
  /// Returns a uniform point in [0, 1)^2 with 24 bits per coordinate.
  constexpr Vec2 next_2d() { return to_unit_vec2((*this)()); }

 private:
  std::uint64_t state_;
};

}  // namespace pharos

#pragma once

#include <cstdint>

#include <pharos/core/random.h>
#include <pharos/sampling/dimension.h>
#include <pharos/sampling/sampler.h>

/// Seeds of the hash-based samplers.
namespace pharos {

/// Combines both halves of the product by exclusive or. Each bit depends on many bits of both
/// factors.
constexpr std::uint64_t folded_product(std::uint64_t a, std::uint64_t b) {
  __extension__ using Long = unsigned __int128;
  const Long product = Long{a} * b;
  return static_cast<std::uint64_t>(product >> 64) ^ static_cast<std::uint64_t>(product);
}

/// Mixes a word that is a sum of words times odd constants (the step of wyrand, Wang Yi 2019).
/// Faster than mix_bits(), but not one to one.
constexpr std::uint64_t mix_sum(std::uint64_t v) {
  return folded_product(v, v ^ 0xe7037ed1a0b428dbull);
}

/// Returns a hash of the seed, the iteration, the index and the number of a part of the pixel (a
/// set, a dimension). All samples of the pixel, or of that part, share the hash.
constexpr std::uint64_t hash_pixel(const PathKey& key, std::uint64_t part = 0) {
  return mix_sum(key.seed * 0x9b05688c2b3e6c1full + key.iteration * 0xd6e8feb86659fd93ull +
                 key.index * 0xa0761d6478bd642full + part * 0xe7037ed1a0b428dbull +
                 0x632be59bd9b4e019ull);
}

/// Four unrelated 32-bit words for one dimension of the pixel or set that `state` identifies.
struct Seeds {
  std::uint32_t order, x, y, more;
};

constexpr Seeds seeds_of(std::uint64_t state, Dimension dimension) {
  const std::uint64_t first =
      mix_sum(state * 0x9b05688c2b3e6c1full + dimension.code() * 0xd6e8feb86659fd93ull +
              0x632be59bd9b4e019ull);
  const std::uint64_t second = folded_product(first, 0x9e3779b97f4a7c15ull);
  return {static_cast<std::uint32_t>(first >> 32), static_cast<std::uint32_t>(first),
          static_cast<std::uint32_t>(second >> 32), static_cast<std::uint32_t>(second)};
}

/// Returns seeds of a number that has the order of another dimension, with scrambles of its own.
constexpr Seeds seeds_of(std::uint64_t state, Dimension ordered_as, std::uint32_t number) {
  const Seeds seeds = seeds_of(state, ordered_as);
  const std::uint64_t own = mix_sum(((std::uint64_t{seeds.order} << 32) | seeds.x) +
                                    (number + 1) * 0xa0761d6478bd642full);
  return {seeds.order, static_cast<std::uint32_t>(own), static_cast<std::uint32_t>(own >> 32),
          seeds.more};
}

/// The place of a sample in sets of a fixed size, packed into the state of a stream. The upper 48
/// bits hold a hash of the pixel and of the number of the set, the lower 16 bits the number within
/// the set.
class SetPlace {
 public:
  /// The largest size of a set.
  static constexpr std::uint32_t kMostSamples = 1u << 16;

  /// Returns the place of a sample in sets of `size` samples, 1 to kMostSamples.
  static constexpr SetPlace of(const PathKey& key, std::uint32_t size) {
    const std::uint32_t set = key.sample / size;
    return SetPlace((hash_pixel(key, set) << 16) | (key.sample - set * size));
  }
  constexpr explicit SetPlace(std::uint64_t state) : state_(state) {}

  constexpr std::uint64_t state() const { return state_; }
  constexpr std::uint64_t set_hash() const { return state_ >> 16; }
  constexpr std::uint32_t index() const { return static_cast<std::uint32_t>(state_ & 0xffffu); }

 private:
  std::uint64_t state_;
};

}  // namespace pharos

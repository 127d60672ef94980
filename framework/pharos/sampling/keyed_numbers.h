#pragma once

#include <cstdint>

#include <pharos/core/random.h>
#include <pharos/sampling/dimension.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// Hashes all members of a path's key to one word.
constexpr std::uint64_t hash_key(const PathKey& key) {
  return hash_combine(
      hash_combine(mix_bits(key.seed ^ (std::uint64_t{key.iteration} << 40)), key.index),
      key.sample);
}

/// Returns independent uniform numbers in [0,1)^2 as a function of hash_key() and the dimension.
constexpr Vec2 keyed_numbers(std::uint64_t key_hash, Dimension dimension) {
  return to_unit_vec2(hash_combine(key_hash, dimension.code()));
}

}  // namespace pharos

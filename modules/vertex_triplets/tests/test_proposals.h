#pragma once

#include <optional>
#include <vector>

#include <pharos/guiding/distribution.h>
#include <pharos/sampling/keyed_numbers.h>

#include "test_gaussians.h"

namespace pharos::triplets::testing {

/// Independent numbers.
class Numbers final : public PreparedSampler {
 public:
  std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return keyed_numbers(stream.state(), dimension).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return keyed_numbers(stream.state(), dimension);
  }
};

inline std::optional<Proposal> propose(const GuidingDistribution& guide, RandomStream& random) {
  static const Numbers numbers;
  const SampleStream stream(numbers, {.seed = 5, .index = random()});
  return guide.propose(VertexStream(stream, 1));
}

/// Gaussians ahead of the origin.
inline std::vector<Gaussian<3>> any_gaussians(int count, std::uint64_t seed) {
  std::vector<Gaussian<3>> result;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    result.push_back(any_gaussian<3>(random, 0.5, 0.2));
    result.back().mean += Vector<3>(0.2, -0.3, 2);
  }
  return result;
}

}  // namespace pharos::triplets::testing

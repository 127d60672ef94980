#pragma once

#include <optional>
#include <vector>

#include <pharos/guiding/contract/distribution.h>
#include <pharos/sampling/keyed_numbers.h>
#include <pharos/scene/local_scattering.h>

#include "test_gaussians.h"

namespace pharos::vertex_triplets::testing {

/// A sampler of independent random numbers.
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

/// A BSDF that reflects like a mirror and transmits like a window, or reflects totally.
class Pane final : public Bsdf {
 public:
  explicit Pane(bool total = false) : total_(total) {}
  EventMask events() const override { return EventMask::discrete; }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint&, Vec3, float, Vec2,
                                      ScatterOptions) const override {
    return std::nullopt;
  }
  DiscreteOutcomes discrete(const SurfacePoint&, Vec3 wo, ScatterOptions) const override {
    const float reflectance = total_ ? 1.0f : 0.3f;
    DiscreteOutcomes outcomes;
    outcomes.add({Event::discrete_reflect, {-wo.x, -wo.y, wo.z}, Rgb(reflectance), reflectance});
    if (total_) return outcomes;
    outcomes.add({Event::discrete_transmit, -wo, Rgb(0.7f), 0.7f});
    return outcomes;
  }
  float roughness(const SurfacePoint&) const override { return 0; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(1); }

 private:
  bool total_;
};

/// Returns random Gaussians ahead of the origin, along +z.
inline std::vector<Gaussian<3>> any_gaussians(int count, std::uint64_t seed) {
  std::vector<Gaussian<3>> result;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    result.push_back(any_gaussian<3>(random, 0.5, 0.2));
    result.back().mean += Vector<3>(0.2, -0.3, 2);
  }
  return result;
}

}  // namespace pharos::vertex_triplets::testing

#pragma once

#include <cstdint>
#include <vector>

#include <pharos/laboratory/integrand.h>
#include <pharos/sampling/sampler.h>

/// The points that a sampler gives to one dimension of one pixel.
namespace pharos::laboratory {

/// Names one set of points: equal keys of equal samplers give equal sets, others unrelated ones.
struct SetKey {
  std::uint64_t seed = 0;
  std::uint32_t log2_count = 0;  ///< of its points
  std::uint64_t realisation = 0;

  std::uint64_t count() const { return std::uint64_t{1} << log2_count; }
};

/// Makes a sampler ready for sets of 2^log2_count points, of one pixel.
std::unique_ptr<const PreparedSampler> prepare(const Sampler& sampler, std::uint64_t seed,
                                               std::uint32_t log2_count);

/// The 2D numbers of `light_position` at the first bounce of samples 0 to N - 1 of the pixel. The
/// seed of their paths is a hash of the key.
std::vector<Vec2> point_set(const PreparedSampler& prepared, const SetKey& key);

/// The same, shifted on the torus by a random vector, a function of the key too: the same for every
/// sampler, of 53 bits a component.
std::vector<PlanePoint> shifted_point_set(const PreparedSampler& prepared, const SetKey& key);

}  // namespace pharos::laboratory

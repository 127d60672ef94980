#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <pharos/laboratory/integrand.h>
#include <pharos/sampling/sampler.h>

/// The points that a sampler gives to one dimension of one pixel.
namespace pharos::laboratory {

/// The 2D numbers that stand for a sampler's: those of `light_position` at the first bounce.
inline constexpr Dimension kDimension{Purpose::light_position, 1};

/// The seed of everything that one sampler gets. Different names have unrelated seeds, so that no
/// two samplers share points, tables or shifts.
std::uint64_t seed_of(std::uint64_t seed, std::string_view sampler_name);

/// Names one set of points, or one preparation for such sets: equal keys of equal samplers give
/// equal sets, others unrelated ones.
struct SetKey {
  std::uint64_t seed = 0;        ///< of a sampler, see seed_of()
  std::uint32_t log2_count = 0;  ///< of its points
  std::uint64_t number = 0;      ///< of the realization, or of the preparation

  std::uint32_t count() const { return std::uint32_t{1} << log2_count; }
};

/// Makes a sampler ready for sets of the key's number of points, with tables that are a function
/// of the key.
std::unique_ptr<const PreparedSampler> prepare(const Sampler& sampler, const SetKey& key);

/// The numbers of samples 0 to N - 1 of the pixel. The seed of their paths is a hash of the key.
std::vector<Vec2> point_set(const PreparedSampler& prepared, const SetKey& key);

/// The same, shifted on the torus by a random vector, a function of the key too, of 53 bits a
/// component.
std::vector<PlanePoint> shifted_point_set(const PreparedSampler& prepared, const SetKey& key);

}  // namespace pharos::laboratory

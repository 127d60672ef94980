#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <pharos/laboratory/integrand.h>
#include <pharos/sampling/sampler.h>

/// The points that a sampler gives to one dimension of one pixel.
namespace pharos::laboratory {

/// The dimension that represents a sampler: the 2D numbers of `light_position` at the first bounce.
inline constexpr Dimension kDimension{Purpose::light_position, 1};

/// Returns the seed of everything that one sampler gets. Different names have unrelated seeds, so
/// no two samplers share points, tables or shifts.
std::uint64_t seed_of(std::uint64_t seed, std::string_view sampler_name);

/// Identifies one set of points, or one preparation for such sets. Equal keys of equal samplers
/// give equal sets. Different keys give unrelated sets.
struct SetKey {
  std::uint64_t seed = 0;        ///< seed of a sampler, see seed_of()
  std::uint32_t log2_count = 0;  ///< logarithm of the number of points
  std::uint64_t number = 0;      ///< number of the realization or of the preparation

  std::uint32_t count() const { return std::uint32_t{1} << log2_count; }
};

/// Prepares a sampler for sets with the key's number of points. Its tables are a function of the
/// key.
std::unique_ptr<const PreparedSampler> prepare(const Sampler& sampler, const SetKey& key);

/// Returns the numbers of samples 0 to N - 1 of the pixel. The seed of their paths is a hash of the
/// key.
std::vector<Vec2> point_set(const PreparedSampler& prepared, const SetKey& key);

/// Returns the same numbers, shifted on the torus by a random vector of 53 bits per component,
/// which is also a function of the key.
std::vector<PlanePoint> shifted_point_set(const PreparedSampler& prepared, const SetKey& key);

}  // namespace pharos::laboratory

#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include "lobe_simd.h"
#include "vmf_fit.h"

namespace pharos::parallax_aware_mixtures {

/// Eight lobes of a mixture as they are seen from its pivot; what is beyond the last one weighs
/// nothing.
struct LobeGroup {
  Float8 weight{};            ///< those of all groups add up to 1
  Float8 mean[3]{};           ///< unit
  Float8 kappa{};             ///< >= kLeastKappa
  Float8 mode{};              ///< the lobe's density at its mean [1/sr]
  Float8 inverse_distance{};  ///< of where its light comes from [1/scene unit]; 0: infinitely far
};

/// Lobes that are flatter count as this flat: quotients of differences stay sound.
inline constexpr float kLeastKappa = 1e-3f;

/// No light is nearer [1/scene unit]: what is beyond is damage.
inline constexpr double kLargestInverse = 1e12;

/// Appends a mixture's groups; `inverse_distances` has one for each lobe.
void append_groups(const Mixture& mixture, std::span<const double> inverse_distances,
                   std::vector<LobeGroup>& groups);

void save_groups(std::span<const LobeGroup> groups, std::ostream& out);
/// Throws InputError when it is no mixture or damaged.
std::vector<LobeGroup> load_groups(std::istream& in);

}  // namespace pharos::parallax_aware_mixtures

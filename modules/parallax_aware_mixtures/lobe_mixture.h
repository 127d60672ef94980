#pragma once

#include <span>
#include <vector>

#include "lobe_simd.h"
#include "vmf_fit.h"

namespace pharos::parallax_aware_mixtures {

/// Eight lobes of a mixture as seen from its pivot. Missing lobes have weight 0.
struct LobeGroup {
  Float8 weight{};            ///< the weights of all groups add up to 1
  Float8 mean[3]{};           ///< unit
  Float8 kappa{};             ///< >= von_mises_fisher::kLeastKappa
  Float8 mode{};              ///< the lobe's density at its mean [1/sr]
  Float8 inverse_distance{};  ///< 1 / distance of the light [1/scene unit]; 0: infinitely far

  void archive(Archive& archive);
};

/// Upper bound of inverse distances [1/scene unit]. A file with larger ones is damaged.
inline constexpr double kLargestInverse = 1e12;

/// Appends the groups of a mixture. `inverse_distances` has one value for each lobe.
void append_groups(const Mixture& mixture, std::span<const double> inverse_distances,
                   std::vector<LobeGroup>& groups);

/// Returns whether `groups` is empty or consists of valid lobes whose weights add up to one.
bool is_sound(const std::vector<LobeGroup>& groups);

}  // namespace pharos::parallax_aware_mixtures

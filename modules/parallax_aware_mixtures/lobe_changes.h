#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vmf_fit.h"

/// What tells that a mixture has a lobe too many or too few, and where lobes' light comes from
/// (Ruppert et al. 2020, sections 4.3 and 5).
namespace pharos::parallax_aware_mixtures {

/// A lobe with the place that it shows.
struct PlacedLobe {
  Lobe lobe;
  double inverse_distance = 0;  ///< [1/scene unit]; 0: infinitely far

  /// As it is seen from `step` further on: the direction and distance change, nothing else.
  PlacedLobe seen_from(const Direction& step) const;
};

/// Both in one: moments add up.
Lobe merged(const Lobe& a, const Lobe& b);

/// What merging two lobes would cost: the chi-square divergence of both from the one that stands
/// for them, times their weight, (p_i^2 I_ii + 2 p_i p_j I_ij + p_j^2 I_jj) / p - p, I_ij being the
/// integral of v_i v_j / v.
double merge_cost(const Lobe& a, const Lobe& b);

/// A lobe in two, side by side along an axis: lobes that merge to the same one again.
std::array<Lobe, 2> halves(const Lobe& lobe, const Direction& axis, double most_kappa);

/// A sample as it is seen from the pivot of its cell.
struct AimedSample {
  Vec3 direction;
  float inverse_distance = 0;
  float weight = 0;  ///< as in Sample
  float pdf = 0;     ///< as in Sample
};

/// What samples say of one lobe; adds up.
struct Assessment {
  double samples = 0;
  double divergence_sum = 0;  ///< see divergence()
  double weight = 0;          ///< of samples, by responsibility
  /// Their second moments in the plane across the mean, times weight, in world space.
  statistics::Matrix<3> spread = statistics::Matrix<3>::Zero();
  double inverse = 0, certainty = 0;  ///< sum of inverse distances, weighted; sum of these weights

  /// The Pearson chi-square divergence, the lobe's part of it:
  ///
  ///     D_k = 1/N sum_n p_k v_k(w_n) (f_n / q_n - 1)^2 / p(w_n)
  ///
  /// with the mixture's density q and the density f of what was found, whose integral is estimated
  /// from the same samples (Ruppert et al. 2020, eq. 24). Samples that found nothing count.
  double divergence() const { return samples > 0 ? divergence_sum / samples : 0; }
  /// Tangential axis of largest variance about `mean`, times half a standard deviation; empty
  /// where there is nothing to tell it from.
  std::optional<Direction> half_axis(const Direction& mean) const;

  Assessment& operator+=(const Assessment& other);
  Assessment& operator*=(double factor);
};

/// Of all lobes. `least_density` [1/sr] stands below q: that a mixture gives nothing to a direction
/// matters only as far as nobody else samples it. The same for any number of threads.
std::vector<Assessment> assess(const Mixture& mixture, std::span<const AimedSample> samples,
                               float least_density);

}  // namespace pharos::parallax_aware_mixtures

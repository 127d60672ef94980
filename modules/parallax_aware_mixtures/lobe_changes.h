#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vmf_fit.h"

/// Criteria for merging and splitting lobes, and the distances of the lobes' lights (Ruppert et al.
/// 2020, sections 4.3 and 5).
namespace pharos::parallax_aware_mixtures {

/// A lobe with the distance of its light.
struct PlacedLobe {
  Lobe lobe;
  double inverse_distance = 0;  ///< [1/scene unit]; 0: infinitely far

  /// Returns the lobe as seen from an origin moved by `step`. Only the direction and the distance
  /// change.
  PlacedLobe seen_from(const Direction& step) const;
};

/// Returns the lobe whose moments are the sum of both lobes' moments.
Lobe merged(const Lobe& a, const Lobe& b);

/// Returns the cost of merging two lobes: the chi-square divergence of the pair from the merged
/// lobe v, times the pair's weight p. It is (p_i^2 I_ii + 2 p_i p_j I_ij + p_j^2 I_jj) / p - p,
/// where I_ij is the integral of v_i v_j / v.
double merge_cost(const Lobe& a, const Lobe& b);

/// Splits a lobe in two, side by side along an axis. Merging both gives the original lobe again.
std::array<Lobe, 2> halves(const Lobe& lobe, const Direction& axis, double most_kappa);

/// A sample as seen from the pivot of its cell.
struct AimedSample {
  Vec3 direction;
  float inverse_distance = 0;
  float weight = 0;  ///< as in Sample
  float pdf = 0;     ///< as in Sample
  float steps = 1;   ///< as in Sample
};

/// The statistics of one lobe over samples. Assessments can be added.
struct Assessment {
  double samples = 0;         ///< number of steps for which they count
  double divergence_sum = 0;  ///< see divergence()
  double weight = 0;          ///< sum of the samples' weights, by responsibility
  /// Weighted second moments of the samples in the plane across the mean, in world space.
  statistics::Matrix<3> spread = statistics::Matrix<3>::Zero();
  double inverse = 0, certainty = 0;  ///< weighted sum of inverse distances; sum of these weights

  void archive(Archive& archive) {
    archive(samples, divergence_sum, weight, spread, inverse, certainty);
  }

  /// Returns the lobe's part of the Pearson chi-square divergence:
  ///
  ///     D_k = 1/N sum_n s_n p_k v_k(w_n) (f_n / q_n - 1)^2 / p(w_n),   N = sum_n s_n,
  ///
  /// where sample n counts for s_n steps, q is the mixture's density and f is the normalized
  /// density of the incident light (Ruppert et al. 2020, eq. 24). The integral of the light that
  /// normalizes f is estimated from the same samples. Samples without light count.
  double divergence() const { return samples > 0 ? divergence_sum / samples : 0; }
  /// Returns the tangential axis of largest variance about `mean`, with the length of half a
  /// standard deviation. Returns nothing if the samples do not determine it.
  std::optional<Direction> half_axis(const Direction& mean) const;

  Assessment& operator+=(const Assessment& other);
  Assessment& operator*=(double factor);
};

/// Assesses all lobes. `least_density` [1/sr] is added to q: a direction that the mixture leaves
/// out matters only as far as unguided sampling does not find it. The result is the same for any
/// number of threads.
std::vector<Assessment> assess(const Mixture& mixture, std::span<const AimedSample> samples,
                               float least_density);

}  // namespace pharos::parallax_aware_mixtures

#pragma once

#include <span>
#include <vector>

#include <pharos/statistics/gaussian_mixture.h>

#include "sample.h"

/// Criteria for merging and splitting the components of a mixture.
namespace pharos::spatial_gaussians {

using Mixture = statistics::GaussianMixture<3>;
using Moments3 = statistics::Moments<3>;
using Gaussian3 = statistics::Gaussian<3>;

/// The cost of merging two components to the Gaussian N of their joint moments. It is the
/// chi-square divergence of the pair from N, times the pair's weight:
///
///     (p_i^2 I_ii + 2 p_i p_j I_ij + p_j^2 I_jj) / p - p,   p = p_i + p_j,
///
/// I_ij is the integral of N_i N_j / N (Ruppert et al. 2020, here for spatial Gaussians). The cost
/// is infinite if this integral does not exist.
double merge_cost(double weight_i, const Gaussian3& i, double weight_j, const Gaussian3& j);

/// The Pearson chi-square test of a mixture, over the directions of samples. For each component it
/// estimates
///
///     D_k = 1/N sum_n s_n p_k N_k(w_n) (f_n / q_n - 1)^2 / p(w_n),   N = sum_n s_n,
///
/// where sample n counts for s_n steps, q is the mixture's directional density at the sample's own
/// origin, and f is the normalized density of the incident light (Ruppert et al. 2020, eq. 24). The
/// integral of the light that normalizes f is estimated from the same samples. Samples without
/// light count. `least_density` [1/sr] is added to q: a direction that the mixture leaves out
/// matters only as far as unguided sampling does not find it.
struct DirectionTest {
  double sum = 0;      ///< N D_k
  double samples = 0;  ///< N [steps]

  void archive(Archive& archive) { archive(sum, samples); }
  double divergence() const { return samples > 0 ? sum / samples : 0; }
};
std::vector<DirectionTest> test_directions(const Mixture& mixture,
                                           const statistics::Vector<3>& pivot,
                                           std::span<const Sample> samples, float least_density);

}  // namespace pharos::spatial_gaussians

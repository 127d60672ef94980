#pragma once

#include <span>
#include <vector>

#include <pharos/statistics/gaussian_mixture.h>

#include "sample.h"

/// What tells that a mixture has a component too many or too few.
namespace pharos::spatial_gaussians {

using Mixture = statistics::GaussianMixture<3>;
using Moments3 = statistics::Moments<3>;
using Gaussian3 = statistics::Gaussian<3>;

/// What merging two components to the Gaussian of their joint moments would cost: the chi-square
/// divergence of both from it, times their weight,
///
///     (p_i^2 I_ii + 2 p_i p_j I_ij + p_j^2 I_jj) / p - p,   p = p_i + p_j,
///
/// I_ij being the integral of N_i N_j / N (Ruppert et al. 2020, for spatial Gaussians). Infinite
/// where that does not exist.
double merge_cost(double weight_i, const Gaussian3& i, double weight_j, const Gaussian3& j);

/// The Pearson chi-square test of a mixture, over the directions of samples: for each component
///
///     D_k = 1/N sum_n p_k N_k(w_n) (f_n / q_n - 1)^2 / p(w_n),
///
/// with the mixture's density q at the sample's own origin, and the density f of what was found,
/// its integral being estimated from the same samples (Ruppert et al. 2020, eq. 24). Samples that
/// found nothing count; those without density do not. `least_density` [1/sr] stands below q: that a
/// mixture gives nothing to a direction matters only as far as nobody else samples it.
struct DirectionTest {
  double sum = 0;      ///< N D_k
  double samples = 0;  ///< N

  double divergence() const { return samples > 0 ? sum / samples : 0; }
};
std::vector<DirectionTest> test_directions(const Mixture& mixture,
                                           const statistics::Vector<3>& pivot,
                                           std::span<const Sample> samples, float least_density);

}  // namespace pharos::spatial_gaussians

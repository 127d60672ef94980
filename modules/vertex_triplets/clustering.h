#pragma once

#include "expectation_maximization.h"

namespace pharos::vertex_triplets {

struct ClusterSettings {
  std::size_t most_components = 128;
  FitSettings fit;
};

/// Fits a mixture to points and chooses the number of components. Clusters are split in two, the
/// worst fit first (PCA-Part, Su and Dy 2007; Schuessler et al. 2022, section 6.3). A split tries
/// the planes through the mean across each eigenvector of the covariance; two-component
/// expectation-maximization then refines the best one. A split is kept if it improves Akaike's
/// information criterion. Finally, expectation-maximization refines the whole mixture.
///
/// Without beliefs, the first cluster has all points. With beliefs, there is one cluster for each
/// belief at the beginning, with the points that it explains best. Points outside of the truncated
/// Gaussians of all beliefs form a further cluster, of which nothing is believed. A belief is
/// dropped if a Gaussian of the cluster's points alone, or a split of the cluster, is better by the
/// same criterion. Requires at least one point or belief, and no more beliefs than components.
template <int D>
Mixture<D> fit_clusters(const Points<D>& points, const ClusterSettings& settings,
                        const Beliefs<D>& beliefs = {});

/// The mixture before the final expectation-maximization, and the points in the order of its
/// clusters.
template <int D>
struct Clusters {
  Mixture<D> mixture;
  Points<D> points;
  Beliefs<D> beliefs;  ///< those that were not dropped, in the order of the mixture
};
/// Requires at least one point.
template <int D>
Clusters<D> find_clusters(const Points<D>& points, const ClusterSettings& settings,
                          const Beliefs<D>& beliefs = {});

}  // namespace pharos::vertex_triplets

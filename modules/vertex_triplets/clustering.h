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
/// information criterion. Finally, expectation-maximization refines the whole mixture. Requires at
/// least one point.
template <int D>
Mixture<D> fit_clusters(const Points<D>& points, const ClusterSettings& settings);

/// The mixture before the final expectation-maximization, and the points in the order of its
/// clusters.
template <int D>
struct Clusters {
  Mixture<D> mixture;
  Points<D> points;
};
template <int D>
Clusters<D> find_clusters(const Points<D>& points, const ClusterSettings& settings);

}  // namespace pharos::vertex_triplets

#pragma once

#include "expectation_maximization.h"

namespace pharos::vertex_triplets {

struct ClusterSettings {
  std::size_t most_components = 128;
  FitSettings fit;
};

/// A mixture for points, of as many components as they bear: clusters are split in two, the worst
/// fitted first, at planes through their means across each eigenvector of their covariances, the
/// best of which two-component expectation-maximization refines (PCA-Part, Su and Dy 2007;
/// Schuessler et al. 2022, section 6.3), while Akaike's information criterion gains; then
/// expectation-maximization of all. At least one point.
template <int D>
Mixture<D> fit_clusters(const Points<D>& points, const ClusterSettings& settings);

/// The mixture before that last step, and the points in the order of its clusters.
template <int D>
struct Clusters {
  Mixture<D> mixture;
  Points<D> points;
};
template <int D>
Clusters<D> find_clusters(const Points<D>& points, const ClusterSettings& settings);

}  // namespace pharos::vertex_triplets

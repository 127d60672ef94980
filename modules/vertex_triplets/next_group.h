#pragma once

#include <pharos/core/lanes3.h>
#include <pharos/core/simd.h>
#include <pharos/guiding/contract/spatial_gaussian.h>
#include <pharos/scene/events.h>

namespace pharos::vertex_triplets {

/// Up to eight components given the prefix of a path, one in each lane: truncated Gaussians of the
/// next vertex. All have the same event at the current vertex and the same kind of next vertex.
/// Lanes without a component have the share 0 and any Gaussian.
struct NextGroup {
  static constexpr unsigned kLanes = 8;

  NextGroup() {}  // leaves the members uninitialized, so that arrays of groups are not cleared

  Float8 share;         ///< probability of choosing the component [1]
  Lanes3<Float8> mean;  ///< [scene units]
  Float8 cholesky[6];   ///< as in SpatialGaussian
  Event event;
  VertexKind kind;

  /// Leaves no component in any lane.
  void clear();
  /// Sets the component of a lane. Its weight becomes the share.
  void set(unsigned lane, const SpatialGaussian& gaussian);
  /// Returns one component with its share as the weight.
  SpatialGaussian gaussian(unsigned lane) const {
    SpatialGaussian g{share[lane], lane_of(mean, lane), {}};
    for (int i = 0; i < 6; ++i) g.cholesky[i] = cholesky[i][lane];
    return g;
  }
};

/// Returns the densities of truncated_point() at a point, for each component [1/scene unit^3].
Float8 truncated_densities(const NextGroup& group, Point3 point);

}  // namespace pharos::vertex_triplets

#pragma once

#include <array>

#include "next_group.h"

namespace pharos::vertex_triplets {

/// Eight distributions of directions to the points of truncated Gaussians, each projected on the
/// plane through its mean that is orthogonal to the line of sight (Schuessler et al. 2022, section
/// 5.2).
class Projections {
 public:
  Projections() {}  // leaves the members uninitialized, so that arrays are not cleared
  Projections(const NextGroup& group, Point3 origin);

  /// Returns where the mean is farther than `least` [scene units]. There is no line of sight
  /// otherwise.
  Mask8 possible(float least) const { return distance_ > least; }
  /// Samples a unit direction of one lane from numbers in [0, 1).
  Vec3 sample(unsigned lane, Vec2 u) const;
  /// Returns the densities of sample() [1/sr]: q(y) d^2 / cos^3.
  Float8 densities(Vec3 direction) const;

 private:
  Lanes3<Float8> towards_;                ///< the line of sight, unit
  std::array<Lanes3<Float8>, 2> across_;  ///< axes of the plane, unit
  Float8 distance_;                       ///< d [scene units]
  Float8 l00_, l10_, l11_;                ///< Cholesky factor of the projected covariance
  Float8 over_l00_, over_l11_;
  Float8 weight_;  ///< factor of the density that does not depend on the direction
};

}  // namespace pharos::vertex_triplets

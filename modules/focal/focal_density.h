#pragma once

#include <optional>

#include "octree.h"

namespace pharos::focal {

/// The guiding density over space (Rath et al. 2023, section 4), which is high at points where
/// lines that carry light meet. Directions point toward converging points. Directions point away
/// from diverging points, for example virtual images behind the surface. Both octrees cover the
/// same box, and their masses add up to one.
struct FocalDensity {
  Octree converging, diverging;

  /// Returns the density of converging and diverging points together [1/scene unit^3].
  double at(Point3 p) const { return converging.density(p) + diverging.density(p); }

  /// Returns the density of sample_direction() at `from` [1/sr] (eq. 6 and 7). It integrates to
  /// one.
  double directional_density(Point3 from, Vec3 direction) const;

  /// Samples a direction toward a converging point or away from a diverging point, from random
  /// numbers in [0, 1) (eq. 3 and 13). Cells of small mass need the digits of `u` beyond a float.
  /// Returns nothing if the sampled point is `from` itself.
  std::optional<Vec3> sample_direction(Point3 from, float sign, const Double3& u) const;

  void archive(Archive& archive) { archive(converging, diverging); }
  std::size_t size_bytes() const { return converging.size_bytes() + diverging.size_bytes(); }
};

}  // namespace pharos::focal

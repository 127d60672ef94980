#pragma once

#include <optional>

#include "octree.h"

namespace pharos::focal {

/// The guiding density over space (Rath et al. 2023, section 4): where lines that carry light meet.
/// Converging points are aimed at; diverging ones, such as virtual images behind the surface, are
/// aimed away from. Both octrees are about the same box, and their masses add up to one.
struct FocalDensity {
  Octree converging, diverging;

  /// Of both signs together [1/scene unit^3].
  double at(Point3 p) const { return converging.density(p) + diverging.density(p); }

  /// Density of sample_direction() at `from` [1/sr] (eq. 6 and 7); integrates to one.
  double directional_density(Point3 from, Vec3 direction) const;

  /// The direction to a converging point, or from a diverging one, from numbers in [0, 1) (eq. 3
  /// and 13). Empty in the one point where there is none.
  std::optional<Vec3> sample_direction(Point3 from, float sign, Vec2 u, float v) const;

  std::size_t size_bytes() const { return converging.size_bytes() + diverging.size_bytes(); }
};

}  // namespace pharos::focal

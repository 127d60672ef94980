#pragma once

#include <span>

#include <pharos/core/arena.h>
#include <pharos/core/lanes3.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/toolkit/scattering_lobes.h>

#include "lobe_mixture.h"

namespace pharos::parallax_aware_mixtures {

/// Eight lobes as seen from a vertex.
struct SeenGroup {
  SeenGroup() {}  // leaves the members uninitialized, so that arrays of groups are not cleared

  Lanes3<Float8> mean;
  Float8 kappa;
  Float8 slope;  ///< -log2(e) kappa / 2; times squared_distance() it is the exponent to base 2
  Float8 share;  ///< probability of choosing the lobe
  Float8 scale;  ///< share times the density at the mean [1/sr]
};

/// A mixture of lobes as seen from a vertex: a distribution over directions.
class SeenLobes {
 public:
  /// Makes the mixture seen from a vertex with `offset` = pivot - vertex. Lobes point at their
  /// lights (parallax; Ruppert et al. 2020, section 5). The mixture is then multiplied by the sum
  /// of the factors; their products with lobes are lobes again. Without factors it stays unchanged.
  /// The result lives in `arena`. Returns null if the product is zero.
  static const SeenLobes* make(std::span<const LobeGroup> groups, Vec3 offset,
                               std::span<const ScatteringLobe> factors, Arena& arena);

  explicit SeenLobes(std::span<const SeenGroup> groups) : groups_(groups) {}

  /// Returns the density of sample() [1/sr]; it integrates to one.
  float density(Vec3 direction) const;
  /// Samples a unit direction from numbers in [0, 1).
  Vec3 sample(float choice, Vec2 u) const;

 private:
  std::span<const SeenGroup> groups_;
};

}  // namespace pharos::parallax_aware_mixtures

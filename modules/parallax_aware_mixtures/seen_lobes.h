#pragma once

#include <span>

#include <pharos/core/arena.h>
#include <pharos/core/vec.h>

#include "lobe_mixture.h"

namespace pharos::parallax_aware_mixtures {

/// Eight lobes as they are seen from a vertex.
struct SeenGroup {
  SeenGroup() {}  // leaves everything as it is: an array of groups need not be cleared

  Float8 mean[3];
  Float8 kappa;
  Float8 slope;  ///< -log2(e) kappa / 2: times squared_distance() the exponent to base 2
  Float8 share;  ///< probability of choosing the lobe
  Float8 scale;  ///< share times the density at the mean [1/sr]
};

/// One lobe that a mixture is multiplied by.
struct Factor {
  Vec3 mean;        ///< unit
  float kappa = 0;  ///< > 0
  float peak = 1;   ///< its value at the mean, up to what all factors of a product share
};

/// A mixture of lobes as it is seen from a vertex: a distribution over directions.
class SeenLobes {
 public:
  /// The mixture seen from `offset` = pivot - vertex: lobes point at where their light comes from
  /// (parallax; Ruppert et al. 2020, section 5), times the sum of the factors, whose products with
  /// lobes are lobes again; none: as it is. Lives in `arena`. Null when nothing is left.
  static const SeenLobes* make(std::span<const LobeGroup> groups, Vec3 offset,
                               std::span<const Factor> factors, Arena& arena);

  explicit SeenLobes(std::span<const SeenGroup> groups) : groups_(groups) {}

  /// The density of sample() [1/sr]; integrates to one.
  float density(Vec3 direction) const;
  /// A unit direction from numbers in [0, 1).
  Vec3 sample(float choice, Vec2 u) const;

 private:
  std::span<const SeenGroup> groups_;
};

}  // namespace pharos::parallax_aware_mixtures

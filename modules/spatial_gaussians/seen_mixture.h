#pragma once

#include <array>
#include <optional>
#include <span>

#include <pharos/core/arena.h>
#include <pharos/core/simd.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/contract/spatial_mixture.h>

namespace pharos::spatial_gaussians {

/// How a direction is made from a point of a Gaussian, seen_gaussian.h has the densities.
enum class Technique {
  exact,    ///< the direction to the point (p0)
  flipped,  ///< the same, turned around where it looks away from the mean (p1)
  plane     ///< the direction to the point's foot in the plane through the mean, facing the origin
};

/// How components are weighted at a surface.
struct CosineRule {
  Vec3 normal;              ///< unit, on the side of the path; zero: weights stay as they are
  bool both_sides = false;  ///< surfaces that transmit
  float least = 0.01f;      ///< in place of smaller cosines, those below the horizon included
};

/// Eight components as they are seen from one point: of a unit direction omega, `rows` make the
/// whitened direction in a frame whose first axis points at the whitened mean, times l00 (a factor
/// that keeps floats in range). They are multiplied by omega's difference from `aim`, of which the
/// last two rows leave nothing: small angles from the mean keep their digits.
struct SeenGroup {
  SeenGroup() {}  // leaves everything as it is: an array of groups need not be cleared

  Float8 rows[3][3];
  Float8 ahead;         ///< the first row times `aim`
  Float8 aim[3];        ///< unit direction to the mean; zero in the mean itself
  Float8 aim_rest[3];   ///< what rounding has taken from it
  Double8 wide_aim[3];  ///< the same before rounding; for `plane` only
  Float8 share;         ///< probability of choosing the component
  Float8 weight;        ///< the density's factor that does not hang on the direction
  Float8 reach;         ///< |L^-1 mu|; for `plane` |mu| / l00
  Float8 far;           ///< e^(-reach^2 / 2)
};

/// A mixture of Gaussians as it is seen from one point: a distribution over directions. Weights are
/// multiplied by the cosine between the normal and the direction to each mean (Lelyakin et al.
/// 2025, section 2).
class SeenMixture {
 public:
  /// Lives in `arena`, as long as it and the components do. Null where nothing can be drawn: all
  /// components are seen from their own means, for `plane`.
  static const SeenMixture* make(std::span<const SpatialGaussian> components, Point3 origin,
                                 const CosineRule& rule, Technique technique, Arena& arena);

  explicit SeenMixture(std::span<const SpatialGaussian> components, Point3 origin,
                       std::span<const SeenGroup> groups, Technique technique)
      : components_(components), groups_(groups), origin_(origin), technique_(technique) {}

  /// The density of sample() [1/sr]; integrates to one.
  float density(Vec3 direction) const;

  /// A unit direction from numbers in [0, 1). Empty in the one point where there is none.
  std::optional<Vec3> sample(float choice, Vec2 u, float v) const;

 private:
  std::span<const SpatialGaussian> components_;
  std::span<const SeenGroup> groups_;
  Point3 origin_;
  Technique technique_;
};

}  // namespace pharos::spatial_gaussians

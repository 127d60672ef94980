#pragma once

#include <optional>
#include <span>

#include <pharos/core/arena.h>
#include <pharos/core/lanes3.h>
#include <pharos/core/simd.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/contract/spatial_gaussian.h>
#include <pharos/guiding/contract/whitened_group.h>
#include <pharos/guiding/toolkit/scattering_lobes.h>

namespace pharos::spatial_gaussians {

/// How a sampled point of a Gaussian becomes a direction. The densities are in seen_gaussian.h.
enum class Technique {
  exact,    ///< the direction to the point (p0)
  flipped,  ///< the same, flipped if it points away from the mean (p1)
  plane     ///< the direction to the point's projection on the plane through the mean that is
            ///< orthogonal to the line from the origin to the mean
};

/// How components are reweighted at a vertex. The weight of each component is multiplied by the
/// cosine between the normal and the direction to its mean (Lelyakin et al. 2025, section 2), or by
/// the integral of its directions times lobes in place of BSDF and cosine. This integral takes the
/// component for a von Mises-Fisher lobe.
struct FactorRule {
  Vec3 normal;              ///< unit, on the side of the path; zero: no cosine
  bool both_sides = false;  ///< true for surfaces that transmit: the absolute cosine counts
  float least = 0.01f;  ///< lower bound of cosines, and of integrals relative to even scattering
  /// The lobes of the BSDF or phase function; none: it does not count.
  std::span<const ScatteringLobe> lobes = {};
};

/// Eight components as seen from one point. A direction omega is whitened as omega - aim, so that
/// small angles from the mean keep their digits.
struct SeenGroup {
  SeenGroup() {}  // leaves the members uninitialized, so that arrays of groups are not cleared

  Whitening8<Float8> whitening;
  Lanes3<Float8> towards;   ///< unit direction to the whitened mean; x axis if that is zero
  Float8 ahead;             ///< length of the whitened `aim`, times l00
  Lanes3<Float8> aim;       ///< unit direction to the mean; zero if seen from the mean itself
  Lanes3<Float8> aim_rest;  ///< rounding error of `aim`
  Double8 wide_aim[3];      ///< `aim` before rounding; for `plane` only
  Float8 share;             ///< probability of choosing the component
  Float8 weight;            ///< factor of the density that does not depend on the direction
  Float8 reach;             ///< |L^-1 mu|; for `plane` |mu| / l00
  Float8 far;               ///< e^(-reach^2 / 2)
};

/// A mixture of Gaussians as seen from one point: a distribution over directions. The weights of
/// components are multiplied as FactorRule says.
class SeenMixture {
 public:
  /// Makes the mixture in `arena`. It is valid as long as the arena and the components are. Returns
  /// null if nothing can be sampled: for `plane`, if all components are seen from their own means.
  /// `whitened` holds the same components; if it is empty, they are whitened here.
  static const SeenMixture* make(std::span<const SpatialGaussian> components, Point3 origin,
                                 const FactorRule& rule, Technique technique, Arena& arena,
                                 std::span<const WhitenedGroup> whitened = {});

  explicit SeenMixture(std::span<const SpatialGaussian> components, Point3 origin,
                       std::span<const SeenGroup> groups, Technique technique)
      : components_(components), groups_(groups), origin_(origin), technique_(technique) {}

  /// Returns the density of sample() [1/sr]; it integrates to one.
  float density(Vec3 direction) const;

  /// Samples a unit direction from numbers in [0, 1). Returns nothing if the sampled point is the
  /// origin itself.
  std::optional<Vec3> sample(float choice, Vec2 u, float v) const;

 private:
  std::span<const SpatialGaussian> components_;
  std::span<const SeenGroup> groups_;
  Point3 origin_;
  Technique technique_;
};

}  // namespace pharos::spatial_gaussians

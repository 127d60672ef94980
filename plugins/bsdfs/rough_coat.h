#pragma once

#include <array>
#include <cstddef>

#include <pharos/core/vec.h>

#include "facets.h"

namespace pharos {

/// A clear coat with a microfacet surface, seen from outside. It gives the reflected light and the
/// share of light that enters. The transmittance is one minus the reflectance of single
/// reflections, so no light is lost: most light that facets reflect onto each other does enter in
/// the end. The transmittance has no closed form and is tabulated. Its errors are below 0.001 for
/// alpha >= 0.001, and below 0.003 for smoother coats at grazing angles.
class RoughCoat {
 public:
  /// Takes `alpha` in (0, 1] and the index `ior` of the coat relative to the outside, at least 1.
  /// Runs for a few milliseconds with GGX, and for a few tens of milliseconds with Beckmann's
  /// distribution, unless the process has had such a coat before.
  RoughCoat(FacetDistribution distribution, float alpha, float ior,
            Masking masking = Masking::height_correlated);

  /// The share [1] of light that enters from a direction with the given `cosine` to the normal.
  float transmittance(float cosine) const;

  /// Reflection from `wo` to `wi`, both with z > 0.
  struct Reflection {
    float weight = 0;  ///< value f |cos(wi)| over pdf [1]
    float pdf = 0;     ///< of sample() [1/sr]
  };
  Reflection reflect(Vec3 wo, Vec3 wi) const;

  /// Draws a mirrored direction. Its z may be negative; nothing is reflected then.
  Vec3 sample(Vec3 wo, Vec2 u) const;

 private:
  /// Nodes lie at cosine = x^4, evenly spaced in x, because details at grazing angles are as narrow
  /// as alpha.
  static constexpr std::size_t kIntervals = 128;
  using Table = std::array<float, kIntervals + 1>;

  float reflectance(float cosine) const;
  Table tabulated_transmittance() const;

  Facets facets_;
  float ior_;
  Masking masking_;
  Table transmittance_;
};

}  // namespace pharos

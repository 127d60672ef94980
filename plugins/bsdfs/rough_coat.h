#pragma once

#include <array>
#include <cstddef>

#include <pharos/core/vec.h>

#include "facets.h"

namespace pharos {

/// A clear coat whose surface are microfacets, seen from outside: what it mirrors, and how much
/// it lets in. The transmittance is one minus the reflectance of single reflections, so that no
/// light is lost: what facets reflect onto each other mostly enters after all. It is tabulated, as
/// it has no closed form; errors are below 0.001 for alpha >= 0.001, and below 0.003 for smoother
/// coats at grazing angles.
class RoughCoat {
 public:
  /// `alpha` in (0, 1], `ior` of the coat over outside, at least 1. Takes some milliseconds,
  /// with Beckmann's distribution some tens.
  RoughCoat(FacetDistribution distribution, float alpha, float ior,
            Masking masking = Masking::height_correlated);

  /// Share [1] of light from direction `wo` that enters.
  float transmittance(float cosine) const;

  /// What is mirrored from `wo` to `wi`, both with z > 0.
  struct Reflection {
    float weight = 0;  ///< value f |cos(wi)| over pdf [1]
    float pdf = 0;     ///< of sample() [1/sr]
  };
  Reflection reflect(Vec3 wo, Vec3 wi) const;

  /// A mirrored direction; its z may be negative, and then nothing is reflected.
  Vec3 sample(Vec3 wo, Vec2 u) const;

 private:
  float reflectance(float cosine) const;

  /// Nodes lie at cosine = x^4, evenly in x: details at grazing angles are as narrow as alpha.
  static constexpr std::size_t kIntervals = 128;

  Facets facets_;
  float ior_;
  Masking masking_;
  std::array<float, kIntervals + 1> transmittance_;
};

}  // namespace pharos

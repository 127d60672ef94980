#pragma once

#include <cmath>
#include <optional>

#include <pharos/core/vec.h>

#include "fresnel.h"

namespace pharos {

/// Returns `w`, flipped vertically if `wo` lies below the surface.
inline Vec3 turned(Vec3 w, Vec3 wo) {
  return {w.x, w.y, wo.z > 0 ? w.z : -w.z};
}

/// The facet of a rough interface that refracts one given direction into another.
struct RefractingFacet {
  Vec3 normal;     ///< unit length, above the surface
  float cosine;    ///< cosine of wo to the normal, in (0, 1]
  float fresnel;   ///< reflectance of the facet [1]
  float jacobian;  ///< solid angle of normals over solid angle of wi [1]
};

/// Returns the facet that refracts `wo` (z > 0) into `wi` (z < 0); `eta` is the index below over
/// the index above. Empty if there is no such facet.
inline std::optional<RefractingFacet> refracting_facet(Vec3 wo, Vec3 wi, float eta) {
  // The facet's normal lies on the side of the smaller index. Its length before normalization is
  // |o.m + eta i.m|.
  const Vec3 normal = eta > 1 ? -(wo + eta * wi) : wo + eta * wi;
  const float squared = length_squared(normal);
  const Vec3 m = normal / std::sqrt(squared);
  const float cos_o = dot(wo, m), cos_i = -dot(wi, m);
  if (!(m.z > 0 && cos_o > 0 && cos_i > 0)) return {};
  // Computed from the thinner side, where cosines near total reflection are small and keep their
  // digits.
  const float fresnel = eta > 1 ? dielectric_fresnel(std::min(1.0f, cos_o), eta).reflectance
                                : dielectric_fresnel(std::min(1.0f, cos_i), 1 / eta).reflectance;
  // The Jacobian follows Walter et al. 2007, eq. 17.
  return RefractingFacet{m, std::min(1.0f, cos_o), fresnel, eta * eta * cos_i / squared};
}

/// Returns the direction into which a facet of normal `m` reflects or refracts light from `wo` (o.m
/// >= 0). Refraction must not be total reflection. Empty if the direction lies on the wrong side of
/// the surface as a whole.
inline std::optional<Vec3> facet_direction(Vec3 wo, Vec3 m, float eta, bool reflects) {
  const float cosine = std::min(1.0f, dot(wo, m));
  const float factor =
      reflects ? 2 * cosine : cosine / eta - dielectric_fresnel(cosine, eta).cos_transmitted;
  const Vec3 wi = normalize(factor * m - (reflects ? wo : wo / eta));
  if (reflects ? !(wi.z > 0) : !(wi.z < 0)) return {};
  return wi;
}

}  // namespace pharos

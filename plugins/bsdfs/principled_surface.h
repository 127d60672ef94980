#pragma once

#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>

namespace pharos {

/// The clearcoat's distribution of microfacet normals: GTR with exponent one, a narrow peak in a
/// wide haze (Burley 2012, "Physically Based Shading at Disney").
class CoatDistribution {
 public:
  /// `alpha` in (0, 1).
  explicit CoatDistribution(float alpha) : alpha_(alpha) {}
  /// The density of facets with normal `m`, z > 0, over projected solid angle [1/sr].
  float density(Vec3 m) const;
  /// Draws a normal with the density density(m) m.z [1/sr].
  Vec3 sample(Vec2 u) const;

 private:
  float alpha_;
};

/// The formulas of `principled` at one point of a surface; see principled.cpp. Directions and facet
/// normals are unit vectors in the shading frame, flipped so that `wo` lies above the surface.
struct PrincipledSurface {
  Rgb base_color;         ///< [1]
  float roughness;        ///< [1], square root of alpha
  float alpha;            ///< GGX roughness of the interface
  float metallic;         ///< [1]
  float spec_trans;       ///< [1]
  float spec_tint;        ///< [1]
  float sheen;            ///< [1]
  float sheen_tint;       ///< [1]
  float flatness;         ///< [1]
  float clearcoat;        ///< [1]
  float clearcoat_gloss;  ///< [1]
  float ior;              ///< index inside over outside

  /// The weights of the matt lobe and of transmission [1].
  float matt_weight() const { return (1 - metallic) * (1 - spec_trans); }
  float clear_weight() const { return (1 - metallic) * spec_trans; }

  /// The shares of light that a facet of the interface reflects and transmits [1].
  struct Shares {
    Rgb reflected, transmitted;
  };
  /// The shares for the facet's Fresnel reflectance `dielectric` [1] and Schlick weight `schlick`
  /// [1].
  Shares shares(float dielectric, float schlick, bool outside) const;
  /// The shares at `cosine` in [0, 1] to the facet, with its Fresnel reflectance `dielectric` [1].
  Shares shares_at(float cosine, float dielectric, bool outside) const;

  /// f cos(i) [1/sr] of the matt lobe and of sheen for the half vector m; outside only.
  Rgb matt(Vec3 wo, Vec3 wi, Vec3 m) const;
  /// The approximate share [1] of light that matt() scatters.
  float matt_albedo() const;

  /// The clearcoat's roughness and its distribution of facets.
  float coat_alpha() const { return lerp(0.1f, 0.001f, clearcoat_gloss); }
  CoatDistribution coat_facets() const { return CoatDistribution(coat_alpha()); }
  /// f cos(i) [1/sr] of the clearcoat for the half vector m; outside only.
  float coat(Vec3 wo, Vec3 wi, Vec3 m) const;
  /// The approximate share [1] of light that coat() scatters.
  float coat_albedo(Vec3 wo) const;

 private:
  Rgb tint() const;
  Rgb sheen_color() const;
};

}  // namespace pharos

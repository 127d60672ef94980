#pragma once

#include <variant>

#include <pharos/config/values.h>

#include "beckmann.h"
#include "ggx.h"
#include "microfacet.h"

namespace pharos {

/// The distribution of the facet normals of a rough surface.
enum class FacetDistribution {
  ggx,       ///< long tails: a bright highlight in a wide haze
  beckmann,  ///< Gaussian slopes: a highlight without haze
};
template <>
struct EnumNames<FacetDistribution> {
  static constexpr auto names = std::to_array<EnumName<FacetDistribution>>(
      {{"ggx", FacetDistribution::ggx}, {"beckmann", FacetDistribution::beckmann}});
};

/// Microfacets whose distribution the user chooses. Directions have the same conventions as in
/// Microfacets.
class Facets {
 public:
  /// Takes the roughness along x and along y, in (0, 1].
  Facets(FacetDistribution distribution, float alpha_x, float alpha_y)
      : either_(distribution == FacetDistribution::ggx
                    ? Either(Microfacets(GgxDistribution(alpha_x, alpha_y)))
                    : Either(Microfacets(BeckmannDistribution(alpha_x, alpha_y)))) {}

  /// Draws a normal that is visible from `wo`.
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    return std::visit([&](const auto& f) { return f.sample_visible_normal(wo, u); }, either_);
  }

  /// Shadowing and sampling density of light that is scattered at a visible normal.
  struct Passage {
    float shadowing;  ///< G2(o, i) / G1(o) [1]
    float pdf;        ///< [1/sr]
  };
  /// From `wo` to its mirror direction `wi` about `m`. The density is the density of `wi`.
  Passage mirrored(Vec3 wo, Vec3 wi, Vec3 m, Masking masking) const {
    const auto way = [&](const auto& f) {
      return Passage{f.shadowing(wo, wi, masking), f.visible_reflection_pdf(wo, m)};
    };
    return std::visit(way, either_);
  }
  /// From `wo` to `wi` by any event at `m`, o.m > 0. The density is the density of `m`.
  Passage by_normal(Vec3 wo, Vec3 wi, Vec3 m, Masking masking) const {
    const auto way = [&](const auto& f) {
      return Passage{f.shadowing(wo, wi, masking), f.visible_normal_pdf(wo, m)};
    };
    return std::visit(way, either_);
  }

 private:
  using Either = std::variant<Microfacets<GgxDistribution>, Microfacets<BeckmannDistribution>>;
  Either either_;
};

}  // namespace pharos

#pragma once

#include <variant>

#include <pharos/config/values.h>

#include "beckmann.h"
#include "ggx.h"
#include "microfacet.h"

namespace pharos {

/// How the facets of a rough surface are tilted.
enum class FacetDistribution {
  ggx,       ///< with long tails: a bright highlight in a wide haze
  beckmann,  ///< with Gaussian slopes: a highlight that ends
};
template <>
struct EnumNames<FacetDistribution> {
  static constexpr std::array<std::pair<std::string_view, FacetDistribution>, 2> names{
      {{"ggx", FacetDistribution::ggx}, {"beckmann", FacetDistribution::beckmann}}};
};

/// Microfacets of a distribution that a user chooses; all directions are as in Microfacets.
class Facets {
 public:
  /// Roughness along x and along y, in (0, 1].
  Facets(FacetDistribution distribution, float alpha_x, float alpha_y)
      : either_(distribution == FacetDistribution::ggx
                    ? Either(Microfacets(GgxDistribution(alpha_x, alpha_y)))
                    : Either(Microfacets(BeckmannDistribution(alpha_x, alpha_y)))) {}

  /// A normal visible from `wo`.
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    return std::visit([&](const auto& f) { return f.sample_visible_normal(wo, u); }, either_);
  }

  /// What becomes of light by way of a visible normal.
  struct Passage {
    float shadowing;  ///< G2(o, i) / G1(o) [1]
    float pdf;        ///< [1/sr]
  };
  /// From `wo` to its mirror direction `wi` about `m`; the density is that of `wi`.
  Passage mirrored(Vec3 wo, Vec3 wi, Vec3 m, Masking masking) const {
    const auto way = [&](const auto& f) {
      return Passage{f.shadowing(wo, wi, masking), f.visible_reflection_pdf(wo, m)};
    };
    return std::visit(way, either_);
  }
  /// From `wo` to `wi` by any event at `m`, o.m > 0; the density is that of `m`.
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

#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/distribution.h>
#include <pharos/scene/local_scattering.h>

#include "conditional_mixtures.h"
#include "truncated_normal.h"

namespace pharos::vertex_triplets {

/// How directions to surfaces are made from Gaussians.
enum class SurfaceTechnique {
  projected,  ///< projected on a plane (Schuessler et al. 2022, section 5.2)
  p0,         ///< to points of the whole Gaussian (Lelyakin et al. 2025, eq. 2)
  p1          ///< the same, turned to the side of the mean (eq. 3)
};

/// How the next vertex is sampled.
struct StepRules {
  SurfaceTechnique technique = SurfaceTechnique::projected;
  /// Below this roughness, a square root of GGX alpha or of 1 - |g|, directions are more and more
  /// left to BSDF and phase function (eq. 22, 23); above 0.
  float specular_roughness = 0.2f;
};

/// Where paths go on to from one vertex, by a mixture of truncated Gaussians of the next one. For
/// each component: with a probability that depends on the roughness (eq. 23) a direction by the
/// BSDF or phase function, given the component's event, and in media a distance by the Gaussian
/// along it; else a point of the Gaussian, or its direction.
class NextDistribution final : public GuidingDistribution {
 public:
  /// A component with what its density needs.
  struct Branch {
    NextVertex vertex;
    Projection projection;  ///< of components on surfaces, for `projected`
  };

  /// Lives in `arena`; null when no component can be sampled. Components nearer than `least`
  /// [scene units] have no direction for `projected`.
  static const NextDistribution* make(std::span<const NextVertex> vertices,
                                      const LocalScattering& scattering, Point3 origin,
                                      const StepRules& rules, float least, std::uint32_t region,
                                      Arena& arena);

  NextDistribution(std::span<const Branch> branches, const LocalScattering& scattering,
                   Point3 origin, const StepRules& rules, std::uint32_t region);

  std::optional<Proposal> propose(const VertexStream& stream) const override;
  Density density(const ResolvedVertex& vertex) const override;
  std::uint32_t region() const override { return region_; }

 private:
  /// A direction to a component's points [1/sr].
  Vec3 direction_to(const Branch& branch, Vec2 u, float v) const;
  float direction_density(const Branch& branch, Vec3 direction) const;
  /// A direction of BSDF or phase function by the event; zero if there is none.
  Vec3 scattered_direction(Event event, const VertexStream& stream) const;
  /// The density of a component's own share, in the measure of the vertex.
  float density(const Branch& branch, const ResolvedVertex& vertex, float scattering_pdf) const;
  /// The probability that directions are left to BSDF or phase function (eq. 23).
  float by_scattering(Event event) const { return is_discrete(event) ? 1.0f : by_scattering_; }

  std::span<const Branch> branches_;
  const LocalScattering& scattering_;
  Point3 origin_;
  SurfaceTechnique technique_;
  float by_scattering_;  ///< for smooth events
  std::uint32_t region_;
};

}  // namespace pharos::vertex_triplets

namespace pharos {
template <>
struct EnumNames<vertex_triplets::SurfaceTechnique> {
  static constexpr std::array<std::pair<std::string_view, vertex_triplets::SurfaceTechnique>, 3>
      names{{{"projected", vertex_triplets::SurfaceTechnique::projected},
             {"p0", vertex_triplets::SurfaceTechnique::p0},
             {"p1", vertex_triplets::SurfaceTechnique::p1}}};
};
}  // namespace pharos

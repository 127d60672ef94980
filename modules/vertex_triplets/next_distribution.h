#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/core/arena.h>
#include <pharos/guiding/contract/distribution.h>
#include <pharos/scene/local_scattering.h>

#include "next_group.h"
#include "projections.h"

namespace pharos::vertex_triplets {

/// How a Gaussian becomes a distribution of directions to surfaces.
enum class SurfaceTechnique {
  projected,  ///< the Gaussian is projected on a plane (Schuessler et al. 2022, section 5.2)
  p0,         ///< directions to points of the whole Gaussian (Lelyakin et al. 2025, eq. 2)
  p1          ///< the same, flipped to the side of the mean (eq. 3)
};

/// How the next vertex is sampled.
struct StepRules {
  SurfaceTechnique technique = SurfaceTechnique::projected;
  /// r_max > 0: the lower the roughness r is below this value, the more often the BSDF or phase
  /// function samples the direction (eq. 22, 23). r is the square root of the GGX alpha or of
  /// 1 - |g|.
  float specular_roughness = 0.2f;
};

/// The guiding distribution at one vertex: a mixture of truncated Gaussians of the next vertex.
/// After the choice of a component, the BSDF or phase function samples a direction with a
/// probability that depends on the roughness (eq. 23), given the component's event; in media, the
/// Gaussian along this direction then samples the distance. Otherwise a point of the Gaussian, or
/// its direction, is sampled.
class NextDistribution final : public GuidingDistribution {
 public:
  /// A group of components with precomputed values for its densities.
  struct Branches {
    Branches() {}  // leaves the members uninitialized, so that arrays of it are not cleared

    const NextGroup* next;
    Float8 share;            ///< probability of choosing the component [1]
    Projections projection;  ///< of components on surfaces, for `projected`
  };

  /// Makes the distribution in `arena`. Returns null if no component can be sampled. For
  /// `projected`, components whose mean is nearer than `least` [scene units] are left out. The
  /// groups must live as long as the distribution.
  static const NextDistribution* make(std::span<const NextGroup> groups,
                                      const LocalScattering& scattering, Point3 origin,
                                      const StepRules& rules, float least, Arena& arena);

  NextDistribution(std::span<const Branches> branches, const LocalScattering& scattering,
                   Point3 origin, const StepRules& rules);

  std::optional<Proposal> propose(const VertexStream& stream) const override;
  float density(const ResolvedVertex& vertex) const override;

 private:
  /// One component.
  struct Branch {
    const Branches* group;
    unsigned lane;
  };

  /// Chooses a component in proportion to its share.
  Branch choose(float u) const;
  /// Samples a vector to a point of a component. It is not normalized; in media its length is the
  /// distance.
  Vec3 direction_to(const Branch& branch, Vec2 u, float v) const;
  /// Samples a direction of the BSDF or phase function for the event; returns zero if there is
  /// none.
  Vec3 scattered_direction(Event event, const VertexStream& stream) const;
  /// Returns the densities of the components of a group, in the measure of the vertex.
  Float8 densities(const Branches& branches, const ResolvedVertex& vertex,
                   float scattering_pdf) const;
  /// Returns the densities of direction_to() for components on surfaces or the environment [1/sr].
  Float8 direction_densities(const Branches& branches, Vec3 direction) const;
  /// Returns the densities of distances along a direction [1/scene unit].
  Float8 distance_densities(const Branches& branches, const ResolvedVertex& vertex) const;
  /// Returns the probability that the BSDF or phase function samples the direction (eq. 23).
  float by_scattering(Event event) const { return is_discrete(event) ? 1.0f : by_scattering_; }

  std::span<const Branches> branches_;
  const LocalScattering& scattering_;
  Point3 origin_;
  SurfaceTechnique technique_;
  float by_scattering_;  ///< for smooth events
};

}  // namespace pharos::vertex_triplets

namespace pharos {
template <>
struct EnumNames<vertex_triplets::SurfaceTechnique> {
  static constexpr auto names = std::to_array<EnumName<vertex_triplets::SurfaceTechnique>>(
      {{"projected", vertex_triplets::SurfaceTechnique::projected},
       {"p0", vertex_triplets::SurfaceTechnique::p0},
       {"p1", vertex_triplets::SurfaceTechnique::p1}});
};
}  // namespace pharos

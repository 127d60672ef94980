#include "first_distribution.h"

#include "truncated_normal.h"

namespace pharos::vertex_triplets {

std::optional<Proposal> FirstDistribution::propose(const VertexStream& stream) const {
  const std::size_t k = mixture_.choose(stream.get_1d(Purpose::guide_choice));
  const FirstVertex& component = mixture_[k];
  const bool in_volume = component.kind == VertexKind::volume;
  const Vec2 u = stream.get_2d(Purpose::guide_direction);
  Vec3 to;
  if (in_volume) {
    to = truncated_point(component.gaussian, u, stream.get_1d(Purpose::guide_distance)) - lens_;
  } else {
    const Projection projection(component.gaussian, lens_);
    if (!projection.is_possible(0)) return std::nullopt;
    to = projection.sample(u);
  }
  const float distance = length(to);
  if (!(distance > 0)) return std::nullopt;
  return Proposal{.direction = to / distance,
                  .reach = in_volume ? Proposal::Reach::distance : Proposal::Reach::surface,
                  .distance = distance,
                  .targets = in_volume ? TargetMask::volume : TargetMask::surface,
                  .within = &mixture_.box(k)};
}

float FirstDistribution::density(const ResolvedVertex& vertex) const {
  float total = 0;
  mixture_.for_each_around(vertex.position, [&](std::size_t k) {
    const FirstVertex& component = mixture_[k];
    if (component.kind != vertex.kind) return;
    const SpatialGaussian& g = component.gaussian;
    if (vertex.kind == VertexKind::volume) {
      total += g.weight * truncated_density(g, vertex.position) * square(vertex.distance);
    } else if (const Projection projection(g, lens_); projection.is_possible(0)) {
      total += g.weight * projection.density(vertex.direction);
    }
  });
  return total;
}

}  // namespace pharos::vertex_triplets

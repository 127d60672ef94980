#include "first_distribution.h"

#include "projections.h"
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
    NextGroup alone;
    alone.clear();
    alone.set(0, component.gaussian);
    const Projections projection(alone, lens_);
    if (projection.possible(0)[0] == 0) return std::nullopt;
    to = projection.sample(0, u);
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
  const bool in_volume = vertex.kind == VertexKind::volume;
  Float8 total{};
  NextGroup group;
  group.clear();
  unsigned count = 0;
  const auto add_group = [&] {
    total += group.share *
             (in_volume ? truncated_densities(group, vertex.position) * square(vertex.distance)
                        : Projections(group, lens_).densities(vertex.direction));
    group.clear();
    count = 0;
  };
  mixture_.for_each_around(vertex.position, [&](std::size_t k) {
    const FirstVertex& component = mixture_[k];
    if (component.kind != vertex.kind) return;
    group.set(count++, component.gaussian);
    if (count == NextGroup::kLanes) add_group();
  });
  if (count > 0) add_group();
  return sum(total);
}

}  // namespace pharos::vertex_triplets

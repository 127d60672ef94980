#include "next_distribution.h"

#include <algorithm>
#include <cmath>

#include <pharos/guiding/toolkit/seen_gaussian.h>

#include "truncated_normal.h"

namespace pharos::vertex_triplets {
namespace {

/// Returns P_BSDF (eq. 22 and 23) for smooth events. Roughness 0 belongs to discrete events and
/// does not concern smooth events at the same vertex.
float scattering_share(const LocalScattering& scattering, float specular_roughness) {
  const float roughness = std::sqrt(scattering.roughness());
  return roughness > 0 ? std::max(0.0f, 1 - roughness / specular_roughness) : 0.0f;
}

/// The kinds of vertices that a step meets if it does not end in a volume: its direction
/// decides between surfaces and the environment.
constexpr TargetMask kBehindVolume = TargetMask::surface | TargetMask::environment;

/// Returns whether a group's next vertices, or the vertex that a step has met, are in a volume.
template <class Next>
bool ends_in_volume(const Next& next) {
  return next.kind == VertexKind::volume;
}

/// Returns the result of `compute(lane)` in all lanes with a component, and 0 in the others.
template <class Compute>
Float8 by_lane(const Float8& share, Compute&& compute) {
  Float8 result{};
  for (unsigned lane = 0; lane < NextGroup::kLanes; ++lane) {
    if (share[lane] > 0) result[lane] = compute(lane);
  }
  return result;
}

}  // namespace

const NextDistribution* NextDistribution::make(std::span<const NextGroup> groups,
                                               const LocalScattering& scattering, Point3 origin,
                                               const StepRules& rules, float least, Arena& arena) {
  Branches* branches = arena.make_array<Branches>(groups.size());
  Float8 total{};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const NextGroup& group = groups[i];
    Branches& branch = branches[i];
    branch.next = &group;
    branch.share = group.share;
    const bool projects = group.kind != VertexKind::volume && !is_discrete(group.event) &&
                          rules.technique == SurfaceTechnique::projected;
    if (projects) {
      branch.projection = Projections(group, origin);
      branch.share = branch.projection.possible(least) ? branch.share : Float8{};
    }
    total += branch.share;
  }
  const float mass = sum(total);
  if (!(mass > 0)) return nullptr;
  for (std::size_t i = 0; i < groups.size(); ++i) branches[i].share *= 1 / mass;
  return arena.make<NextDistribution>(std::span<const Branches>(branches, groups.size()),
                                      scattering, origin, rules);
}

NextDistribution::NextDistribution(std::span<const Branches> branches,
                                   const LocalScattering& scattering, Point3 origin,
                                   const StepRules& rules)
    : branches_(branches),
      scattering_(scattering),
      origin_(origin),
      technique_(rules.technique),
      by_scattering_(scattering_share(scattering, rules.specular_roughness)) {}

auto NextDistribution::choose(float u) const -> Branch {
  Branch chosen{};
  for (const Branches& branches : branches_) {
    for (unsigned lane = 0; lane < NextGroup::kLanes; ++lane) {
      const float share = branches.share[lane];
      if (!(share > 0)) continue;
      chosen = {&branches, lane};  // the last one with a share, if rounding leaves a rest of `u`
      if (u < share) return chosen;
      u -= share;
    }
  }
  return chosen;
}

Vec3 NextDistribution::direction_to(const Branch& branch, Vec2 u, float v) const {
  const NextGroup& next = *branch.group->next;
  const bool in_volume = ends_in_volume(next);
  if (!in_volume && technique_ == SurfaceTechnique::projected) {
    return branch.group->projection.sample(branch.lane, u);
  }
  const SpatialGaussian g = next.gaussian(branch.lane);
  if (in_volume) return truncated_point(g, u, v) - origin_;
  const Vec3 aim = g.mean - origin_;
  const Vec3 to =
      aim + spread(g, {warp::fast_normal_from_unit(u.x), warp::fast_normal_from_unit(u.y),
                       warp::fast_normal_from_unit(v)});
  return technique_ == SurfaceTechnique::p1 && dot(to, aim) < 0 ? -to : to;
}

Vec3 NextDistribution::scattered_direction(Event event, const VertexStream& stream) const {
  if (!is_discrete(event)) {
    const auto sample = scattering_.sample(stream.get_1d(Purpose::bsdf_choice),
                                           stream.get_2d(Purpose::bsdf_direction), mask_of(event));
    return sample ? sample->direction : Vec3{};
  }
  for (const DiscreteOutcome& outcome : scattering_.discrete()) {
    if (outcome.event == event) return outcome.direction;
  }
  return {};
}

std::optional<Proposal> NextDistribution::propose(const VertexStream& stream) const {
  const Branch branch = choose(stream.get_1d(Purpose::guide_choice));
  const NextGroup& next = *branch.group->next;
  const bool in_volume = ends_in_volume(next);
  const float v = stream.get_1d(Purpose::guide_distance);
  const bool scatters = stream.get_1d(Purpose::guide_choice, 1) < by_scattering(next.event);
  const Vec3 to = scatters ? scattered_direction(next.event, stream)
                           : direction_to(branch, stream.get_2d(Purpose::guide_direction), v);
  const float distance = length(to);
  if (!(distance > 0)) return std::nullopt;
  Proposal proposal{.direction = to / distance,
                    .events = mask_of(next.event),
                    .reach = in_volume ? Proposal::Reach::distance : Proposal::Reach::surface,
                    .distance = distance,
                    .targets = in_volume ? TargetMask::volume : kBehindVolume};
  if (scatters && in_volume) {
    const DistancesAlong distances(next.gaussian(branch.lane), origin_, proposal.direction);
    if (!distances.is_possible()) return std::nullopt;
    proposal.distance = distances.sample(v);
    if (!(proposal.distance > 0)) return std::nullopt;
  }
  return proposal;
}

Float8 NextDistribution::direction_densities(const Branches& branches, Vec3 direction) const {
  if (technique_ == SurfaceTechnique::projected) return branches.projection.densities(direction);
  const auto density = technique_ == SurfaceTechnique::p0 ? exact_density : flipped_density;
  return by_lane(branches.share, [&](unsigned lane) {
    return static_cast<float>(density(branches.next->gaussian(lane), origin_, direction));
  });
}

Float8 NextDistribution::distance_densities(const Branches& branches,
                                            const ResolvedVertex& vertex) const {
  return by_lane(branches.share, [&](unsigned lane) {
    const DistancesAlong distances(branches.next->gaussian(lane), origin_, vertex.direction);
    return distances.density(vertex.distance);
  });
}

Float8 NextDistribution::densities(const Branches& branches, const ResolvedVertex& vertex,
                                   float scattering_pdf) const {
  const float scatters = by_scattering(vertex.event);
  const bool in_volume = ends_in_volume(vertex);
  Float8 density{};
  if (scatters > 0 && scattering_pdf > 0) {
    density = all8(scatters * scattering_pdf);
    if (in_volume) density *= distance_densities(branches, vertex);
  }
  if (scatters < 1) {
    const Float8 of_point =
        in_volume ? truncated_densities(*branches.next, vertex.position) * square(vertex.distance)
                  : direction_densities(branches, vertex.direction);
    density += (1 - scatters) * of_point;
  }
  return density;
}

float NextDistribution::density(const ResolvedVertex& vertex) const {
  const bool discrete = is_discrete(vertex.event);
  const float scattering_pdf =
      discrete             ? 1.0f
      : by_scattering_ > 0 ? scattering_.evaluate(vertex.direction, mask_of(vertex.event)).pdf
                           : 0.0f;
  Float8 total{};
  for (const Branches& branches : branches_) {
    if (branches.next->event != vertex.event) continue;
    if (ends_in_volume(*branches.next) != ends_in_volume(vertex)) continue;
    total += branches.share * densities(branches, vertex, scattering_pdf);
  }
  return sum(total);
}

}  // namespace pharos::vertex_triplets

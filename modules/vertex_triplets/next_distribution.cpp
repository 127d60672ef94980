#include "next_distribution.h"

#include <algorithm>
#include <cmath>

#include <pharos/guiding/toolkit/seen_gaussian.h>

namespace pharos::vertex_triplets {
namespace {

/// Returns P_BSDF (eq. 22 and 23) for smooth events. Roughness 0 belongs to discrete events and
/// does not concern smooth events at the same vertex.
float scattering_share(const LocalScattering& scattering, float specular_roughness) {
  const float roughness = std::sqrt(scattering.roughness());
  return roughness > 0 ? std::max(0.0f, 1 - roughness / specular_roughness) : 0.0f;
}

TargetMask mask_of(VertexKind kind) {
  return kind == VertexKind::volume        ? TargetMask::volume
         : kind == VertexKind::environment ? TargetMask::environment
                                           : TargetMask::surface;
}

}  // namespace

const NextDistribution* NextDistribution::make(std::span<const NextVertex> vertices,
                                               const LocalScattering& scattering, Point3 origin,
                                               const StepRules& rules, float least, Arena& arena) {
  Branch* branches = arena.make_array<Branch>(vertices.size());
  std::size_t count = 0;
  float total = 0;
  for (const NextVertex& vertex : vertices) {
    Branch& branch = branches[count];
    branch.vertex = vertex;
    const bool projects = vertex.kind != VertexKind::volume && !is_discrete(vertex.event) &&
                          rules.technique == SurfaceTechnique::projected;
    if (projects) {
      branch.projection = Projection(vertex.gaussian, origin);
      if (!branch.projection.is_possible(least)) continue;
    }
    total += vertex.gaussian.weight;
    ++count;
  }
  if (count == 0) return nullptr;
  for (std::size_t i = 0; i < count; ++i) branches[i].vertex.gaussian.weight /= total;
  return arena.make<NextDistribution>(std::span<const Branch>(branches, count), scattering, origin,
                                      rules);
}

NextDistribution::NextDistribution(std::span<const Branch> branches,
                                   const LocalScattering& scattering, Point3 origin,
                                   const StepRules& rules)
    : branches_(branches),
      scattering_(scattering),
      origin_(origin),
      technique_(rules.technique),
      by_scattering_(scattering_share(scattering, rules.specular_roughness)) {}

Vec3 NextDistribution::direction_to(const Branch& branch, Vec2 u, float v) const {
  const SpatialGaussian& g = branch.vertex.gaussian;
  if (branch.vertex.kind == VertexKind::volume) {
    return truncated_point(g, u, v) - origin_;
  }
  if (technique_ == SurfaceTechnique::projected) return branch.projection.sample(u);
  const Vec3 aim = g.mean - origin_;
  const Vec3 to =
      aim + spread(g, {warp::fast_normal_from_unit(u.x), warp::fast_normal_from_unit(u.y),
                       warp::fast_normal_from_unit(v)});
  return technique_ == SurfaceTechnique::p1 && dot(to, aim) < 0 ? -to : to;
}

float NextDistribution::direction_density(const Branch& branch, Vec3 direction) const {
  const SpatialGaussian& g = branch.vertex.gaussian;
  switch (technique_) {
    case SurfaceTechnique::p0:
      return static_cast<float>(exact_density(g, origin_, direction));
    case SurfaceTechnique::p1:
      return static_cast<float>(flipped_density(g, origin_, direction));
    default:
      return branch.projection.density(direction);
  }
}

Vec3 NextDistribution::scattered_direction(Event event, const VertexStream& stream) const {
  if (!is_discrete(event)) {
    const auto sample =
        scattering_.sample(stream.get_1d(Purpose::bsdf_choice),
                           stream.get_2d(Purpose::bsdf_direction), pharos::mask_of(event));
    return sample ? sample->direction : Vec3{};
  }
  for (const DiscreteOutcome& outcome : scattering_.discrete()) {
    if (outcome.event == event) return outcome.direction;
  }
  return {};
}

std::optional<Proposal> NextDistribution::propose(const VertexStream& stream) const {
  float u = stream.get_1d(Purpose::guide_choice);
  std::size_t i = 0;
  while (i + 1 < branches_.size() && u >= branches_[i].vertex.gaussian.weight) {
    u -= branches_[i++].vertex.gaussian.weight;
  }
  const Branch& branch = branches_[i];
  const NextVertex& next = branch.vertex;
  const bool in_volume = next.kind == VertexKind::volume;
  const float v = stream.get_1d(Purpose::guide_distance);
  const bool scatters = stream.get_1d(Purpose::guide_choice, 1) < by_scattering(next.event);
  const Vec3 to = scatters ? scattered_direction(next.event, stream)
                           : direction_to(branch, stream.get_2d(Purpose::guide_direction), v);
  const float distance = length(to);
  if (!(distance > 0)) return std::nullopt;
  Proposal proposal{.direction = to / distance,
                    .events = pharos::mask_of(next.event),
                    .reach = in_volume ? Proposal::Reach::distance : Proposal::Reach::surface,
                    .distance = distance,
                    .targets = mask_of(next.kind)};
  if (scatters && in_volume) {
    const DistancesAlong distances(next.gaussian, origin_, proposal.direction);
    if (!distances.is_possible()) return std::nullopt;
    proposal.distance = distances.sample(v);
    if (!(proposal.distance > 0)) return std::nullopt;
  }
  return proposal;
}

float NextDistribution::density(const Branch& branch, const ResolvedVertex& vertex,
                                float scattering_pdf) const {
  const float scatters = by_scattering(vertex.event);
  const SpatialGaussian& g = branch.vertex.gaussian;
  const bool in_volume = vertex.kind == VertexKind::volume;
  float density = 0;
  if (scatters > 0 && scattering_pdf > 0) {
    density = scatters * scattering_pdf;
    if (in_volume) {
      const DistancesAlong distances(g, origin_, vertex.direction);
      density *= distances.is_possible() ? distances.density(vertex.distance) : 0;
    }
  }
  if (scatters < 1) {
    const float of_point = in_volume
                               ? truncated_density(g, vertex.position) * square(vertex.distance)
                               : direction_density(branch, vertex.direction);
    density += (1 - scatters) * of_point;
  }
  return density;
}

float NextDistribution::density(const ResolvedVertex& vertex) const {
  const bool discrete = is_discrete(vertex.event);
  const float scattering_pdf =
      discrete ? 1.0f
      : by_scattering_ > 0
          ? scattering_.evaluate(vertex.direction, pharos::mask_of(vertex.event)).pdf
          : 0.0f;
  float total = 0;
  for (const Branch& branch : branches_) {
    if (branch.vertex.event != vertex.event || branch.vertex.kind != vertex.kind) continue;
    total += branch.vertex.gaussian.weight * density(branch, vertex, scattering_pdf);
  }
  return total;
}

}  // namespace pharos::vertex_triplets

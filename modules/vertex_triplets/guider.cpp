#include "guider.h"

#include "first_distribution.h"

namespace pharos::vertex_triplets {
namespace {

/// Returns the events that can scatter light here. For example, total reflection excludes
/// transmission.
EventMask possible_events(const LocalScattering& scattering) {
  EventMask events = scattering.events() & EventMask::smooth;
  if (events == scattering.events()) return events;
  for (const DiscreteOutcome& outcome : scattering.discrete()) {
    events = events | mask_of(outcome.event);
  }
  return events;
}

}  // namespace

void VertexTripletsGuiderSettings::describe(Schema<VertexTripletsGuiderSettings>& s) {
  s.field("surfaces", &VertexTripletsGuiderSettings::surfaces,
          "Directions to surfaces and the environment: Gaussians projected on a plane (the paper), "
          "or directions to points of the Gaussians (`p0`, `p1`)");
  s.field("specular_roughness", &VertexTripletsGuiderSettings::specular_roughness,
          "Roughness (square root of GGX alpha, or of 1 - |g|) below which the BSDF or phase "
          "function samples more and more of the directions")
      .above(0);
  s.field(
       "prefix_deviations", &VertexTripletsGuiderSettings::prefix_deviations,
       "Guides only after prefixes whose coordinates are, as a root mean square, at most this many "
       "standard deviations away from the mean of a component. The truncation of the components "
       "limits the distance to 4")
      .above(0)
      .at_most(kTruncation);
  s.field("guide_camera", &VertexTripletsGuiderSettings::guide_camera,
          "Guide first vertices, and with them the choice of pixels");
}

GuiderTraits VertexTripletsGuider::traits() const {
  return {.steers_distance = true,
          .steers_events = true,
          .guides_camera = settings_.guide_camera,
          .guides_light_paths = true};
}

const GuidingDistribution* VertexTripletsGuider::query(const VertexTripletsModel& model,
                                                       const GuidingQuery& query,
                                                       Arena& arena) const {
  if (query.current.kind == VertexKind::sensor) {
    return arena.make<FirstDistribution>(model.camera(), query.current.position);
  }
  const std::span<const NextGroup> next = model.next_vertices(
      query, possible_events(*query.scattering), arena, settings_.prefix_deviations);
  if (next.empty()) return nullptr;
  constexpr float kLeastDistance = 1e-6f;  // relative to the cell's edge
  return NextDistribution::make(next, *query.scattering, query.current.position,
                                {settings_.surfaces, settings_.specular_roughness},
                                kLeastDistance * model.cell_size(query.region), arena);
}

}  // namespace pharos::vertex_triplets

#include "step_outcomes.h"

#include <cmath>
#include <span>

namespace pharos {
namespace {

/// Returns whether a step was drawn from a vertex, even if it led nowhere. Otherwise the path has
/// reached its largest depth there, or roulette has ended it before a step was drawn.
bool has_drawn(const RecordedVertex& vertex) {
  return vertex.continuation > 0 && (vertex.event != Event::none || vertex.guidable);
}

/// Fills in how many steps each vertex stands for: its own, and those of all vertices after it.
void count_steps(const PathView& path, std::vector<float>& costs) {
  costs.assign(path.vertices.size(), 0);
  // Children come after their parents.
  for (std::size_t i = costs.size(); i-- > 0;) {
    const RecordedVertex& vertex = path.vertices[i];
    if (has_drawn(vertex)) costs[i] += 1;
    if (vertex.parent != kNoVertex) costs[vertex.parent] += costs[i];
  }
}

}  // namespace

PathOutcome OutcomeReader::read(const PathView& path, std::vector<StepOutcome>& steps) {
  estimate_incident_radiance(path, incident_);
  count_steps(path, costs_);
  for (std::size_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& vertex = path.vertices[i];
    if (!has_drawn(vertex) || !vertex.guidable || vertex.parent == kNoVertex) continue;
    const double radiance = mean(vertex.local_weight * incident_[i]) / vertex.continuation;
    if (!std::isfinite(radiance)) continue;
    steps.push_back({.origin = vertex.position,
                     .towards_viewer = -path.vertices[vertex.parent].direction,
                     .radiance = static_cast<float>(radiance),
                     .cost = costs_[i]});
  }
  const RecordedVertex& lens = path.vertices[0];
  const std::span<const Technique> techniques = path.techniques(lens);
  return {mean(lens.throughput * lens.local_weight * incident_[0]), costs_[0],
          techniques.empty() ? 1 : double{techniques[0].density} / lens.pdf};
}

}  // namespace pharos

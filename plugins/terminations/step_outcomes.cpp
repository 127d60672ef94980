#include "step_outcomes.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace pharos {
namespace {

/// Less than the throughput of any path that matters [1].
constexpr float kTiny = 1e-30f;

/// Returns whether a step was drawn from a vertex, even if it led nowhere. Otherwise the path has
/// reached its largest depth there, or roulette has ended it before a step was drawn.
bool has_drawn(const RecordedVertex& vertex) {
  return vertex.continuation > 0 && (vertex.event != Event::none || vertex.guidable);
}

/// Calls `use(index)` for the record `first` of a vertex and for all its later records.
template <class Use>
void for_each_record(const PathView& path, std::uint32_t first, Use&& use) {
  for (std::uint32_t i = first; i != kNoVertex; i = path.vertices[i].twin) use(i);
}

/// Returns the index of record number `copy` of the vertex whose first record is `first`;
/// kNoVertex: there is none.
std::uint32_t record_of_copy(const PathView& path, std::uint32_t first, std::uint32_t copy) {
  while (copy-- > 0 && first != kNoVertex) first = path.vertices[first].twin;
  return first;
}

}  // namespace

// While this learner watches, lights are sampled once for each step, or once in all and there is at
// most one step.
void OutcomeReader::read_lights(const PathView& path) {
  lights_.assign(path.vertices.size(), 0);
  for (const RecordedLightSample& sample : path.light_samples) {
    const std::uint32_t i = record_of_copy(path, sample.vertex, sample.copy);
    if (i != kNoVertex) lights_[i] += mean(sample.contribution) / sample.continuation;
  }
}

void OutcomeReader::count_costs(const PathView& path) {
  costs_.assign(path.vertices.size(), 0);
  for (std::uint32_t i = 0; i < costs_.size(); ++i) {
    if (path.vertices[i].light_samples == 0) continue;
    std::uint32_t records = 0;
    for_each_record(path, i, [&](std::uint32_t) { ++records; });
    const float share = static_cast<float>(path.vertices[i].light_samples) / records;
    for_each_record(path, i, [&](std::uint32_t k) { costs_[k] += share; });
  }
  // Children come after their parents.
  for (std::size_t i = costs_.size(); i-- > 0;) {
    const RecordedVertex& vertex = path.vertices[i];
    if (has_drawn(vertex)) costs_[i] += 1;
    if (vertex.parent != kNoVertex) costs_[vertex.parent] += costs_[i];
  }
}

PathOutcome OutcomeReader::read(const PathView& path, TerminationRule::Stage stage, double limit,
                                std::vector<StepOutcome>& steps) {
  const bool is_late = stage == TerminationRule::Stage::step;
  estimate_incident_radiance(path, incident_);
  read_lights(path);
  count_costs(path);
  for (std::size_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& vertex = path.vertices[i];
    if (!has_drawn(vertex) || !vertex.guidable || vertex.parent == kNoVertex) continue;
    const double radiance =
        mean(vertex.local_weight * incident_[i]) / vertex.continuation + lights_[i];
    if (!std::isfinite(radiance)) continue;
    steps.push_back({.origin = vertex.position,
                     .towards_viewer = -path.vertices[vertex.parent].direction,
                     .radiance = static_cast<float>(radiance),
                     .limited = static_cast<float>(
                         std::min(radiance, limit / std::max(mean(vertex.throughput), kTiny))),
                     .cost = costs_[i],
                     .steps = is_late ? vertex.continuation : 1});
  }
  const RecordedVertex& lens = path.vertices[0];
  const std::span<const Technique> techniques = path.techniques(lens);
  return {mean(lens.throughput * lens.local_weight * incident_[0]), costs_[0],
          techniques.empty() ? 1 : double{techniques[0].density} / lens.pdf};
}

}  // namespace pharos

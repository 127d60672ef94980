#include "outcome_reader.h"

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

/// Returns an outcome at a vertex. `limit` is the largest contribution to the pixel that counts.
Outcome outcome_at(const PathView& path, const RecordedVertex& vertex, double radiance,
                   double limit) {
  return {.origin = vertex.position,
          .towards_viewer = -path.vertices[vertex.parent].direction,
          .radiance = static_cast<float>(radiance),
          .limited = static_cast<float>(
              std::min(radiance, limit / std::max(mean(vertex.throughput), kTiny)))};
}

}  // namespace

void OutcomeReader::read_lights(const PathView& path, std::uint32_t vertex, double limit,
                                std::size_t& sample, std::vector<Outcome>& outcomes) {
  const RecordedVertex& here = path.vertices[vertex];
  found_by_copy_.assign(here.light_copies, 0);
  for (; sample < path.light_samples.size(); ++sample) {
    const RecordedLightSample& found = path.light_samples[sample];
    if (found.vertex != vertex) break;
    if (found.copy >= here.light_copies) continue;
    found_by_copy_[found.copy] += mean(found.contribution) / found.continuation;
  }
  if (here.parent == kNoVertex || !here.guidable) return;
  for (const double radiance : found_by_copy_) {
    if (!std::isfinite(radiance)) continue;
    Outcome outcome = outcome_at(path, here, radiance, limit);
    outcome.cost = static_cast<float>(here.light_samples) / static_cast<float>(here.light_copies);
    outcome.of_light = true;
    outcomes.push_back(outcome);
  }
}

void OutcomeReader::count_costs(const PathView& path) {
  costs_.assign(path.vertices.size(), 0);
  // Children come after their parents.
  for (std::size_t i = costs_.size(); i-- > 0;) {
    const RecordedVertex& vertex = path.vertices[i];
    if (has_drawn(vertex)) costs_[i] += 1;
    if (vertex.parent == kNoVertex) continue;
    costs_[vertex.parent] += costs_[i] + static_cast<float>(vertex.light_samples);
  }
}

PathOutcome OutcomeReader::read(const PathView& path, TerminationRule::Stage stage, double limit,
                                std::vector<Outcome>& outcomes) {
  const bool is_late = stage == TerminationRule::Stage::step;
  estimate_incident_radiance(path, incident_);
  count_costs(path);
  std::size_t sample = 0;
  for (std::uint32_t i = 1; i < path.vertices.size(); ++i) {
    const RecordedVertex& vertex = path.vertices[i];
    read_lights(path, i, limit, sample, outcomes);
    if (!has_drawn(vertex) || !vertex.guidable || vertex.parent == kNoVertex) continue;
    const double radiance = mean(vertex.local_weight * incident_[i]) / vertex.continuation;
    if (!std::isfinite(radiance)) continue;
    Outcome outcome = outcome_at(path, vertex, radiance, limit);
    outcome.cost = costs_[i];
    outcome.count = is_late ? vertex.continuation : 1;
    outcomes.push_back(outcome);
  }
  const RecordedVertex& lens = path.vertices[0];
  const std::span<const Technique> techniques = path.techniques(lens);
  return {mean(lens.throughput * lens.local_weight * incident_[0]), costs_[0],
          techniques.empty() ? 1 : double{techniques[0].density} / lens.pdf};
}

}  // namespace pharos

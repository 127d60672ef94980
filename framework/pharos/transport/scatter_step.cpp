#include <algorithm>

#include <pharos/transport/scatter_step.h>

namespace pharos {
namespace {

/// Fills in the step of a guide's proposal. Returns false if the step has value zero.
bool accept(const LocalScattering& scattering, const Proposal& proposal, ScatterStep& step) {
  step.direction = proposal.direction;
  step.reach = proposal.reach;
  step.distance = proposal.distance;
  step.targets = proposal.targets;
  step.within = proposal.within;
  step.continuation = step.resampling = 1;
  if (is_empty(proposal.events & EventMask::smooth)) {
    for (const DiscreteOutcome& outcome : scattering.discrete()) {
      if (!contains(proposal.events, outcome.event)) continue;
      step.direction = outcome.direction;
      step.event = outcome.event;
      step.value = outcome.value;
      step.unguided_pdf = outcome.probability;
      return true;
    }
    return false;
  }
  step.event = scattering.smooth_event(proposal.direction);
  if (!contains(proposal.events, step.event)) return false;
  const ScatterValue value = scattering.evaluate(proposal.direction);
  if (is_black(value.value)) return false;
  step.value = value.value;
  step.unguided_pdf = value.pdf;
  return true;
}

/// Returns t / p of a candidate; see sample_resampled_step(). The guides steer no distances, so the
/// medium's factor cancels.
float candidate_weight(const Guidance& guidance, const ScatterStep& step) {
  const ResolvedVertex vertex{.direction = step.direction, .event = step.event};
  const float density = step_density(guidance, vertex, step.unguided_pdf).total;
  return density > 0 ? mean(step.value) * guidance.relative_radiance(step.direction) / density : 0;
}

}  // namespace

bool sample_guided_step(const LocalScattering& scattering, const Guidance& guidance,
                        const VertexStream& stream, float u, ScatterStep& step) {
  const std::optional<Proposal> proposal = guidance.propose(stream, guidance.rest_of(u));
  return proposal && accept(scattering, *proposal, step);
}

bool sample_resampled_step(const LocalScattering& scattering, const Guidance& guidance,
                           const VertexStream& stream, ScatterStep& step) {
  constexpr std::uint16_t kChoiceBranch = 1;  // of mix_choice; branch 0 chooses techniques
  const auto count = static_cast<float>(guidance.candidates);
  const float offset = stream.get_1d(Purpose::mix_choice);
  float choice = stream.get_1d(Purpose::mix_choice, kChoiceBranch);
  float total = 0, chosen = 0;
  ScatterStep candidate;
  for (std::uint32_t i = 0; i < guidance.candidates; ++i) {
    // The sum may round up to one.
    const float u = std::min((static_cast<float>(i) + offset) / count, kOneMinusEpsilon);
    const VertexStream numbers = stream.candidate(i);
    if (!(guidance.guides(u) ? sample_guided_step(scattering, guidance, numbers, u, candidate)
                             : sample_unguided_step(scattering, numbers, candidate))) {
      continue;
    }
    const float weight = candidate_weight(guidance, candidate);
    if (!(weight > 0)) continue;
    total += weight;
    // The candidate replaces the chosen one with probability weight / total. The number that
    // decides is uniform again, given the decision.
    const float taken = weight / total;
    if (choice < taken) {
      step = candidate;
      chosen = weight;
      choice /= taken;
    } else {
      choice = (choice - taken) / (1 - taken);
    }
  }
  if (!(chosen > 0)) return false;
  step.resampling = total / (count * chosen);
  return true;
}

}  // namespace pharos

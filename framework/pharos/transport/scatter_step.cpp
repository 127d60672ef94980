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
  step.continuation = 1;
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

}  // namespace

bool sample_guided_step(const LocalScattering& scattering, const Guidance& guidance,
                        const VertexStream& stream, ScatterStep& step) {
  const std::optional<Proposal> proposal = guidance.propose(stream);
  return proposal && accept(scattering, *proposal, step);
}

}  // namespace pharos

#pragma once

#include <optional>

#include <pharos/scene/bsdf.h>

namespace pharos {

/// Those of both outcomes that have a probability and are allowed. One that is left alone is
/// certain, otherwise the probabilities, which must add up to one, stay.
inline DiscreteOutcomes allowed_outcomes(const DiscreteOutcome& a, const DiscreteOutcome& b,
                                         EventMask allowed) {
  DiscreteOutcomes result;
  for (const DiscreteOutcome* o : {&a, &b}) {
    if (o->probability > 0 && contains(allowed, o->event)) result.add(*o);
  }
  if (result.count == 1) result.outcomes[0].probability = 1;
  return result;
}

/// Draws one of at most two outcomes of total probability one; empty when there is none.
inline std::optional<ScatterSample> draw_outcome(const DiscreteOutcomes& all, float u_choice) {
  if (all.count == 0) return std::nullopt;
  const bool first = all.count == 1 || u_choice < all.outcomes[0].probability;
  const DiscreteOutcome& chosen = all.outcomes[first ? 0 : 1];
  return ScatterSample{chosen.direction, chosen.event, chosen.value / chosen.probability,
                       chosen.probability};
}

}  // namespace pharos

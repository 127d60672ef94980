#pragma once

#include <optional>

#include <pharos/scene/bsdf.h>

namespace pharos {

/// Returns the outcomes among `a` and `b` that are allowed and have a nonzero probability. A single
/// remaining outcome gets probability one. Two outcomes keep their probabilities, which must add up
/// to one.
inline DiscreteOutcomes allowed_outcomes(const DiscreteOutcome& a, const DiscreteOutcome& b,
                                         EventMask allowed) {
  DiscreteOutcomes result;
  for (const DiscreteOutcome* o : {&a, &b}) {
    if (o->probability > 0 && contains(allowed, o->event)) result.add(*o);
  }
  if (result.count == 1) result.outcomes[0].probability = 1;
  return result;
}

/// Draws one of at most two outcomes whose probabilities add up to one. Empty if there is no
/// outcome.
inline std::optional<ScatterSample> draw_outcome(const DiscreteOutcomes& all, float u_choice) {
  if (all.count == 0) return std::nullopt;
  const bool first = all.count == 1 || u_choice < all.outcomes[0].probability;
  const DiscreteOutcome& chosen = all.outcomes[first ? 0 : 1];
  return ScatterSample{chosen.direction, chosen.event, chosen.value / chosen.probability,
                       chosen.probability};
}

}  // namespace pharos

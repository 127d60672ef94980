// pass_through: an invisible surface. Light goes straight through and keeps its strength (the event
// `pass_through`). It serves shapes that only bound a medium with the refractive index of its
// surroundings: a cloud, smoke, a box of fog. Paths have no vertex on it, and light samples go
// through it.
//
//     { type: pass_through }
#include "pass_through.h"

#include "discrete_choice.h"

namespace pharos {

std::optional<ScatterSample> PassThrough::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                                 Vec2, ScatterOptions options) const {
  return draw_outcome(discrete(point, wo, options), u_choice);
}

DiscreteOutcomes PassThrough::discrete(const SurfacePoint&, Vec3 wo, ScatterOptions options) const {
  DiscreteOutcomes outcomes;
  if (contains(options.events, Event::pass_through)) {
    outcomes.add({Event::pass_through, -wo, Rgb(1), 1});
  }
  return outcomes;
}

}  // namespace pharos

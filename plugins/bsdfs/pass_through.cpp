// pass_through: a surface that is not there, light goes straight through it and keeps its strength
// (the event `pass_through`). For shapes that only bound a medium of the same refractive index as
// what surrounds it: a cloud, smoke, a box of fog. Paths have no vertex there, and light samples go
// through.
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

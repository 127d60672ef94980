// light: light tracing. Paths start at the lights, each chosen by its power, and whatever they meet
// is seen from the lens, as a splat: caustics that no path from the sensor finds are found, what is
// behind mirrors, glass, masks and the like is not. The first vertex on the light is seen as well;
// environments are seen by sensors that see more than one direction.
//
// One path starts for each sample of a pixel, whatever pixels it then lands in. There are no layers
// of first hits (albedo, normal, depth), and no paths through the middles of pixels alone.
//
//     integrator: { type: light, max_depth: 12 }

#include "light.h"

#include <pharos/core/error.h>
#include <pharos/transport/prepared_light.h>

namespace pharos {

void LightIntegrator::Settings::describe(Schema<Settings>& s) {
  s.field("max_depth", &Settings::max_depth, "Longest path, from the light to the lens")
      .unit("segments")
      .at_least(1);
}

std::unique_ptr<const PreparedIntegrator> LightIntegrator::prepare(
    const RenderTarget& target) const {
  if (!target.jitter) throw InputError("the integrator 'light' needs a film with 'jitter: true'");
  return std::make_unique<PreparedLightTracing<>>(settings_.max_depth, target);
}

}  // namespace pharos

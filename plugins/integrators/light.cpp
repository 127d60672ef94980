// light: light tracing. Paths start at the lights, which are chosen in proportion to power. Every
// vertex is connected to the lens, and its contribution is a splat on the film. Light tracing finds
// caustics that no path from the sensor finds. It does not find what is visible behind mirrors,
// glass, masks and the like. The first vertex, on the light, is connected as well. Environments are
// visible to sensors that see more than one direction.
//
// One path starts for each sample of a pixel, whichever pixel it then contributes to. There are no
// layers of first hits (albedo, normal, depth), and paths cannot be restricted to the centers of
// pixels.
//
//     integrator: { type: light, max_depth: 12 }

#include "light.h"

#include <pharos/config/registry.h>
#include <pharos/core/error.h>
#include <pharos/transport/prepared_light.h>

namespace pharos {

void LightIntegrator::Settings::describe(Schema<Settings>& s) {
  s.field("max_depth", &Settings::max_depth,
          "Length of the longest path from the light to the lens")
      .unit("segments")
      .at_least(1);
  s.field("termination", &Settings::termination,
          "Where paths end by Russian roulette; paths from lights do not split");
}

LightIntegrator::LightIntegrator(const Settings& settings) : settings_(settings) {
  check_learns_nothing(settings.termination);
}

std::unique_ptr<const PreparedIntegrator> LightIntegrator::prepare(
    const RenderTarget& target) const {
  if (!target.jitter) throw InputError("the integrator 'light' needs a film with 'jitter: true'");
  const Ref<Termination>& termination = settings_.termination;
  return std::make_unique<PreparedLightTracing<>>(
      settings_.max_depth, target,
      termination != nullptr ? termination->begin({})->rule() : nullptr);
}

}  // namespace pharos

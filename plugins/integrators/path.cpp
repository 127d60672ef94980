// path: unidirectional path tracing.
//
// Paths start at the sensor. At every vertex that scatters smoothly, lights are sampled (next event
// estimation). The path then continues by the BSDF or phase function, or by the guide if there is
// one. Light that both ways can find is weighted by multiple importance sampling over the full
// density of the mixture (Veach 1997, ch. 9). In media, distances are sampled. Guides may choose
// the first vertex.
//
// Paths end at `max_depth`. A `termination` may end them earlier by Russian roulette, or split them
// where much of the light of their pixel is still to come. `roulette: throughput` is the short form
// of `termination: throughput`.
//
//     integrator:
//       type: path
//       max_depth: 12            # segments: 1 shows only emitters, 2 adds direct light
//       light_selection: all     # one | all
//       termination: adjoint     # none | throughput | adjoint | efficiency
//       guiding: { learner: …, guider: … }

#include "path.h"

#include <pharos/transport/prepared_path.h>

namespace pharos {

PathIntegrator::PathIntegrator(Settings settings) : settings_(std::move(settings)) {
  settings_.check();
}

IntegratorTraits PathIntegrator::traits() const {
  return {
      .records = {.light_samples = true}, .guided = true, .guided_camera = true, .resampled = true};
}

const GuidingSettings* PathIntegrator::guiding() const {
  return settings_.guiding ? &*settings_.guiding : nullptr;
}

const Termination* PathIntegrator::learned_termination() const {
  const Termination* termination = settings_.termination.get();
  return termination != nullptr && termination->learns() ? termination : nullptr;
}

const TrainingSettings* PathIntegrator::training() const {
  return settings_.training_of_all();
}

std::unique_ptr<const PreparedIntegrator> PathIntegrator::prepare(
    const RenderTarget& target) const {
  return std::make_unique<PreparedPath<>>(settings_, target);
}

}  // namespace pharos

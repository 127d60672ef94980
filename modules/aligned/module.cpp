#include <pharos/config/module.h>

#include "aligned_sampler.h"
#include "directions_command.h"
#include "synthesize_command.h"

PHAROS_MODULE(registry) {
  using namespace pharos::aligned;
  registry.add<AlignedSampler>("aligned", "Point sets aligned with the edges of integrands");
  registry.add<DirectionsCommand>("directions",
                                  "Draw the estimated directions of the edges in a scene");
  registry.add<SynthesizeCommand>("synthesize",
                                  "Make point sets with low energy along stated directions");
}

#include <pharos/config/module.h>

#include "aligned_sampler.h"
#include "directions_command.h"
#include "synthesize_command.h"

PHAROS_MODULE(registry) {
  using namespace pharos::aligned;
  constexpr const char* kPaper =
      "M. Werner, J. Hanika, C. Dachsbacher: Optimized and Aligned Anisotropic Monte Carlo "
      "Sampling "
      "Patterns. 2025";
  registry.add<AlignedSampler>("aligned", "Point sets aligned with the edges of integrands",
                               {kPaper});
  registry.add<DirectionsCommand>(
      "directions", "Draw the estimated directions of the edges in a scene", {kPaper});
  registry.add<SynthesizeCommand>(
      "synthesize", "Make point sets with low energy along stated directions", {kPaper});
}

#include <pharos/config/module.h>

#include "synthesize_command.h"

PHAROS_MODULE(registry) {
  using namespace pharos::aligned;
  registry.add<SynthesizeCommand>("synthesize",
                                  "Make point sets with low energy in stated directions");
}

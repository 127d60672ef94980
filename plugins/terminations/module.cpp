#include <pharos/config/module.h>

#include "adjoint.h"
#include "efficiency.h"
#include "none.h"
#include "throughput.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::NoTermination>("none", "Paths neither end early nor split");
  registry.add<pharos::ThroughputTermination>("throughput",
                                              "Russian roulette by the throughput of the path");
  registry.add<pharos::AdjointTermination>(
      "adjoint", "Roulette and splitting by the expected contribution, in a weight window");
  registry.add<pharos::EfficiencyTermination>(
      "efficiency", "Roulette and splitting that maximize the efficiency of the image");
  registry.set_default<pharos::Termination>("none");
}

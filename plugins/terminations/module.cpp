#include <pharos/config/module.h>

#include "none.h"
#include "throughput.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::NoTermination>("none", "Paths neither end early nor split");
  registry.add<pharos::ThroughputTermination>("throughput",
                                              "Russian roulette by the throughput of the path");
  registry.set_default<pharos::Termination>("none");
}

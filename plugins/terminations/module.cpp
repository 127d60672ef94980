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
      "adjoint", "Roulette and splitting by the expected contribution, in a weight window",
      {"J. Vorba, J. Křivánek: Adjoint-Driven Russian Roulette and Splitting in Light Transport "
       "Simulation. ACM Transactions on Graphics 35(4), 2016"});
  registry.add<pharos::EfficiencyTermination>(
      "efficiency", "Roulette and splitting that maximize the efficiency of the image",
      {"A. Rath, P. Grittmann, S. Herholz, P. Weier, P. Slusallek: EARS: Efficiency-Aware Russian "
       "Roulette and Splitting. ACM Transactions on Graphics 41(4), 2022"});
  registry.set_default<pharos::Termination>("none");
}

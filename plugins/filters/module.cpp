#include <pharos/config/module.h>

#include "box.h"
#include "gaussian.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::BoxFilter>("box", "Equal weight over a square");
  registry.add<pharos::GaussianFilter>("gaussian", "A Gaussian that ends at zero");
  registry.set_default<pharos::Filter>("box");
}

#include <pharos/config/module.h>

#include "box.h"
#include "catmull_rom.h"
#include "gaussian.h"
#include "lanczos.h"
#include "mitchell.h"
#include "tent.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::BoxFilter>("box", "Equal weight over a square");
  registry.add<pharos::CatmullRomFilter>("catmull_rom", "An interpolating cubic, sharp");
  registry.add<pharos::GaussianFilter>("gaussian", "A Gaussian that ends at zero");
  registry.add<pharos::LanczosFilter>("lanczos", "A windowed sinc, the sharpest");
  registry.add<pharos::TentFilter>("tent", "A tent that falls linearly to zero");
  registry.add<pharos::MitchellFilter>("mitchell", "Mitchell and Netravali's sharpening cubic");
  registry.set_default<pharos::Filter>("box");
}

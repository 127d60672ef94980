#include <pharos/config/module.h>

#include "area.h"
#include "constant.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::AreaEmitter>("area", "Radiance from the outer side of a shape");
  registry.add<pharos::ConstantEmitter>("constant", "The same radiance from all directions");
}

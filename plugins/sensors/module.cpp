#include <pharos/config/module.h>

#include "orthographic.h"
#include "perspective.h"
#include "thin_lens.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::OrthographicSensor>("orthographic", "A camera with parallel rays");
  registry.add<pharos::PerspectiveSensor>("perspective", "A pinhole camera");
  registry.add<pharos::ThinLensSensor>("thin_lens", "A camera with depth of field");
}

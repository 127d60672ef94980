#include <pharos/config/module.h>

#include "area.h"
#include "constant.h"
#include "directional.h"
#include "directional_area.h"
#include "environment_map.h"
#include "point.h"
#include "sky.h"
#include "spot.h"
#include "sun.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::AreaEmitter>("area", "A shape that emits light on the side of its normal");
  registry.add<pharos::ConstantEmitter>("constant", "The same radiance from all directions");
  registry.add<pharos::DirectionalEmitter>("directional", "Parallel light from far away");
  registry.add<pharos::DirectionalAreaEmitter>("directional_area",
                                               "A shape that emits most light along its normal");
  registry.add<pharos::EnvironmentMap>("environment_map",
                                       "Radiance by direction from a latitude-longitude image");
  registry.add<pharos::PointEmitter>("point", "Light from a point, the same in all directions");
  registry.add<pharos::SkyEmitter>("sky",
                                   "The clear sky for a given turbidity and position of the sun",
                                   {"L. Hosek, A. Wilkie: An Analytic Model for Full Spectral "
                                    "Sky-Dome Radiance. ACM Transactions on Graphics 31(4), 2012"});
  registry.add<pharos::SpotEmitter>("spot", "Light from a point within a cone");
  registry.add<pharos::SunEmitter>("sun", "The sun's disk, attenuated by the atmosphere");
}

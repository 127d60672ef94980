#include <pharos/config/module.h>

#include "mitsuba/mitsuba_importer.h"
#include "pbrt/pbrt_importer.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::MitsubaImporter>("xml", "Scenes of Mitsuba 0.x, 2 and 3");
  registry.add<pharos::PbrtImporter>("pbrt", "Scenes of pbrt-v4");
}

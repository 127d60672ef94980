#include <pharos/config/module.h>

#include "mitsuba/mitsuba_importer.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::MitsubaImporter>("xml", "Scenes of Mitsuba 0.x, 2 and 3");
}

#include <pharos/config/module.h>

#include "stubs.h"

PHAROS_MODULE(registry) {
  pharos::stubs::register_mixture_guiders(registry);
}

#include <pharos/config/module.h>

#include "stubs.h"

PHAROS_MODULE(registry) {
  using namespace pharos::stubs;
  register_direction(registry);
  register_segments(registry);
  register_vertices(registry);
  register_medium(registry);
  register_camera(registry);
  register_mixing(registry);
  register_probing_sampler(registry);
  register_mixture(registry);
  register_memory(registry);
  register_termination(registry);
}

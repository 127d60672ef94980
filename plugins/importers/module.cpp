#include <pharos/config/module.h>

PHAROS_MODULE(registry) {
  static_cast<void>(registry);
}

#include <pharos/core/version.h>

namespace pharos {

std::string version() {
  return PHAROS_VERSION;
}

}  // namespace pharos

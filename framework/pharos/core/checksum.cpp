#include <xxhash.h>

#include <pharos/core/checksum.h>

namespace pharos {

std::uint64_t checksum(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace pharos

#include <pharos/core/parallel.h>
#include <pharos/rendering/unit_runner.h>

namespace pharos {

void LocalUnits::run(const UnitPass& pass) {
  parallel_ordered(pass.count, pass.render, pass.merge,
                   [&](std::size_t) { return pass.keeps_going(); });
}

}  // namespace pharos

#pragma once

#include <pharos/config/registry.h>

namespace pharos::laboratory {

/// Registers the integrands that come with the laboratory. Modules may add others under the
/// contract `integrand`.
void add_integrands(Registry& registry);

}  // namespace pharos::laboratory

#pragma once

#include <memory>

#include <pharos/sampling/integrand_probe.h>

#include "path_settings.h"

namespace pharos {

/// The integrand of `path`, laid open; refers to `shared`.
std::unique_ptr<const IntegrandProbe> make_path_probe(const PathScene& shared);

}  // namespace pharos

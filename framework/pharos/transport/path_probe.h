#pragma once

#include <memory>

#include <pharos/sampling/integrand_probe.h>
#include <pharos/transport/camera_walk.h>

namespace pharos {

/// Makes the probe of path tracing without guides. The probe refers to `shared`.
std::unique_ptr<const IntegrandProbe> make_path_probe(const CameraScene& shared);

}  // namespace pharos

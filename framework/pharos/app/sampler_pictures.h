#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/core/image.h>
#include <pharos/experiments/pictures/point_pictures.h>
#include <pharos/experiments/pictures/sampled_points.h>

namespace pharos {

/// Every registered sampler that has points without a scene, by name, with its defaults or its
/// first example.
std::vector<NamedSampler> pictured_samplers(const Registry& registry);

struct SamplerPictureOptions {
  Dimension dimension{Purpose::light_position, 1};
  std::uint32_t count = 256;  ///< points
  std::uint64_t seed = 1;     ///< of the points that are shown
  int realizations = 400;     ///< that the spectrum is the mean of
  int max_frequency = 40;     ///< of the spectrum
  int edge = 405;             ///< of each square [pixels]; five for each frequency
};

/// The points of one pixel beside their expected power spectrum; of several samplers a column each,
/// points above, spectrum below, five columns side by side. To be written without any tone curve.
/// Samplers must not need a probe.
Image sampler_pictures(std::span<const NamedSampler> samplers,
                       const SamplerPictureOptions& options = {});

}  // namespace pharos

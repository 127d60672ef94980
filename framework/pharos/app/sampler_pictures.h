#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/core/image.h>
#include <pharos/experiments/pictures/point_pictures.h>
#include <pharos/experiments/pictures/sampled_points.h>

namespace pharos {

/// Returns every registered sampler that has points without a scene, sorted by name, with its
/// defaults or its first example.
std::vector<NamedSampler> pictured_samplers(const Registry& registry);

struct SamplerPictureOptions {
  Dimension dimension{Purpose::light_position, 1};
  std::uint32_t count = 256;  ///< number of points
  std::uint64_t seed = 1;     ///< seed of the points that are shown
  int realizations = 400;     ///< number of realizations that the spectrum is averaged over
  int max_frequency = 40;     ///< largest frequency of the spectrum
  int edge = 405;             ///< edge of each square [pixels]; five pixels for each frequency
};

/// Draws the points of one pixel and their expected power spectrum. Each sampler has a column, with
/// the points above and the spectrum below; five columns stand side by side. The image must be
/// written without a tone curve. Samplers must not need a probe.
Image sampler_pictures(std::span<const NamedSampler> samplers,
                       const SamplerPictureOptions& options = {});

}  // namespace pharos

#pragma once

#include <cstdint>
#include <vector>

#include <pharos/sampling/sampler.h>
#include <pharos/statistics/point_sets.h>

/// The points that a sampler gives a pixel, apart from any scene. Samplers must not need a probe.
namespace pharos {

/// The first `count` points of a pixel in `dimension`, of a render with `count` samples a pixel and
/// this seed. The pixel is the same for any seed, in the midst of the film.
std::vector<Vec2> sampled_points(const Sampler& sampler, Dimension dimension, std::uint32_t count,
                                 std::uint64_t seed);

/// The power spectrum of sampled_points() up to `max_frequency`, its mean over the seeds 0 to
/// `realisations` - 1.
statistics::PowerSpectrum expected_spectrum(const Sampler& sampler, Dimension dimension,
                                            std::uint32_t count, int realisations,
                                            int max_frequency);

}  // namespace pharos

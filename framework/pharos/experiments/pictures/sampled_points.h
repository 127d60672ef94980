#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/sampling/sampler.h>
#include <pharos/statistics/point_sets.h>

/// The points that a sampler gives a pixel, apart from any scene. Samplers must not need a probe.
/// The pixel is always the same, in the midst of the film.
namespace pharos {

/// A sampler and what tables and pictures call it.
struct NamedSampler {
  std::string name;
  Ref<Sampler> sampler;

  static void describe(Schema<NamedSampler>& schema);
};

/// Makes a sampler ready for a render of `count` samples a pixel with this seed.
std::unique_ptr<const PreparedSampler> prepare_for_points(const Sampler& sampler,
                                                          std::uint32_t count, std::uint64_t seed);

/// The first `count` points of the pixel in `dimension`, of paths with this seed.
std::vector<Vec2> sampled_points(const PreparedSampler& prepared, Dimension dimension,
                                 std::uint32_t count, std::uint64_t seed);

/// The same of a render with `count` samples a pixel and this seed.
std::vector<Vec2> sampled_points(const Sampler& sampler, Dimension dimension, std::uint32_t count,
                                 std::uint64_t seed);

/// What a mean power spectrum is made of.
struct SpectrumPlan {
  Dimension dimension;
  std::uint32_t count = 0;  ///< points of each set
  int realizations = 0;     ///< sets that it is the mean of
  int max_frequency = 0;    ///< along each axis [cycles per side of the square]
  std::uint64_t seed = 0;   ///< of the first set; that of each further one is larger by one
};

/// The mean power spectrum of sampled_points(). `goes_on` is asked after each set but the last, and
/// ends the work where it says no: the spectrum's count() is then less than what was planned.
statistics::PowerSpectrum expected_spectrum(
    const Sampler& sampler, const SpectrumPlan& plan,
    const std::function<bool()>& goes_on = [] { return true; });

}  // namespace pharos

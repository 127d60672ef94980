#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/sampling/sampler.h>
#include <pharos/statistics/point_sets.h>

/// The points that a sampler gives a pixel, independent of any scene. The samplers must not need a
/// probe. The pixel is always the same one, in the middle of the film.
namespace pharos {

/// A sampler and its name in tables and pictures.
struct NamedSampler {
  std::string name;
  Ref<Sampler> sampler;

  static void describe(Schema<NamedSampler>& schema);
};

/// Prepares a sampler for a render with `count` samples per pixel and this seed.
std::unique_ptr<const PreparedSampler> prepare_for_points(const Sampler& sampler,
                                                          std::uint32_t count, std::uint64_t seed);

/// Returns the first `count` points of the pixel in `dimension`, for paths with this seed.
std::vector<Vec2> sampled_points(const PreparedSampler& prepared, Dimension dimension,
                                 std::uint32_t count, std::uint64_t seed);

/// Prepares `sampler` for a render with `count` samples per pixel and this seed, and returns the
/// same points.
std::vector<Vec2> sampled_points(const Sampler& sampler, Dimension dimension, std::uint32_t count,
                                 std::uint64_t seed);

/// The settings of a mean power spectrum.
struct SpectrumPlan {
  Dimension dimension;
  std::uint32_t count = 0;  ///< number of points of each set
  int realizations = 0;     ///< number of sets that are averaged
  int max_frequency = 0;    ///< largest frequency along each axis [cycles per side]
  std::uint64_t seed = 0;   ///< seed of the first set; each further set adds one
};

/// Returns the mean power spectrum of sampled_points(). `goes_on` is called after each set except
/// the last. If it returns false, the work ends and the spectrum's count() is less than planned.
statistics::PowerSpectrum expected_spectrum(
    const Sampler& sampler, const SpectrumPlan& plan,
    const std::function<bool()>& goes_on = [] { return true; });

}  // namespace pharos

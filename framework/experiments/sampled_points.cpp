#include <pharos/experiments/sampled_points.h>

namespace pharos {
namespace {

constexpr PixelGrid kFilm{64, 64};
constexpr std::uint64_t kPixel = 32 * 64 + 32;

}  // namespace

std::vector<Vec2> sampled_points(const Sampler& sampler, Dimension dimension, std::uint32_t count,
                                 std::uint64_t seed) {
  const auto prepared = sampler.prepare(kFilm, {.seed = seed, .samples_per_pixel = count}, nullptr);
  std::vector<Vec2> points(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const SampleStream stream(*prepared, {.seed = seed, .index = kPixel, .sample = i});
    points[i] = stream.get_2d(dimension);
  }
  return points;
}

statistics::PowerSpectrum expected_spectrum(const Sampler& sampler, Dimension dimension,
                                            std::uint32_t count, int realisations,
                                            int max_frequency) {
  statistics::PowerSpectrum spectrum(max_frequency);
  for (int i = 0; i < realisations; ++i) {
    spectrum.add(sampled_points(sampler, dimension, count, static_cast<std::uint64_t>(i)));
  }
  return spectrum;
}

}  // namespace pharos

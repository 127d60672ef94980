#include <pharos/experiments/pictures/sampled_points.h>
#include <pharos/experiments/runner/entry_names.h>

namespace pharos {
namespace {

constexpr PixelGrid kFilm{64, 64};
constexpr std::uint64_t kPixel = 32 * 64 + 32;

}  // namespace

void NamedSampler::describe(Schema<NamedSampler>& s) {
  s.field("name", &NamedSampler::name, "Name in tables")
      .required()
      .check(kEntryNameRule, is_entry_name);
  s.field("sampler", &NamedSampler::sampler, "Sampler that makes the points").required();
}

std::unique_ptr<const PreparedSampler> prepare_for_points(const Sampler& sampler,
                                                          std::uint32_t count, std::uint64_t seed) {
  return sampler.prepare(kFilm, {.seed = seed, .samples_per_pixel = count}, nullptr);
}

std::vector<Vec2> sampled_points(const PreparedSampler& prepared, Dimension dimension,
                                 std::uint32_t count, std::uint64_t seed) {
  std::vector<Vec2> points(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const SampleStream stream(prepared, {.seed = seed, .index = kPixel, .sample = i});
    points[i] = stream.get_2d(dimension);
  }
  return points;
}

std::vector<Vec2> sampled_points(const Sampler& sampler, Dimension dimension, std::uint32_t count,
                                 std::uint64_t seed) {
  return sampled_points(*prepare_for_points(sampler, count, seed), dimension, count, seed);
}

statistics::PowerSpectrum expected_spectrum(const Sampler& sampler, const SpectrumPlan& plan,
                                            const std::function<bool()>& goes_on) {
  statistics::PowerSpectrum spectrum(plan.max_frequency);
  for (int i = 0; i < plan.realizations; ++i) {
    if (i > 0 && !goes_on()) break;
    spectrum.add(sampled_points(sampler, plan.dimension, plan.count,
                                plan.seed + static_cast<std::uint64_t>(i)));
  }
  return spectrum;
}

}  // namespace pharos

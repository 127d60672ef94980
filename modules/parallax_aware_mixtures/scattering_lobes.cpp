#include "scattering_lobes.h"

#include <algorithm>
#include <cmath>

#include "vmf.h"

namespace pharos::vmf {
namespace {

constexpr std::uint32_t kMostSamples = 64;
constexpr float kMostKappa = 1e5f;

/// Directions that are to become a lobe.
struct Heap {
  Vec3 resultant;
  float weight = 0;

  void add(Vec3 direction, float w) {
    resultant = resultant + w * direction;
    weight += w;
  }
  /// Empty of directions: of no weight.
  Factor lobe(float total) const {
    const float size = length(resultant);
    if (!(size > 0)) return {};
    // A half of a direction more, of no preference, so that few of them are no needle.
    const float cosine = size / (weight * (1 + 0.5f / kMostSamples));
    const float kappa = cosine * (3 - cosine * cosine) / ((1 - cosine) * (1 + cosine));
    const float bounded = std::clamp(kappa, kLeastKappa, kMostKappa);
    const auto mode = static_cast<float>(mode_density(bounded));
    return {resultant / size, bounded, mode * weight / total};
  }
};

/// Point i of a fixed set in three dimensions: a line, and a rank-1 lattice by the plastic number.
struct FixedNumbers {
  float choice;
  Vec2 u;
};
FixedNumbers fixed_numbers(std::uint32_t i, std::uint32_t count) {
  const auto part = [&](double step) {
    const double x = (i + 0.5) * step;
    return static_cast<float>(x - std::floor(x));
  };
  return {part(1.0 / count), {part(0.75487766624669276), part(0.56984029099805327)}};
}

}  // namespace

ScatteringLobes fit_scattering(const LocalScattering& scattering, std::uint32_t samples) {
  struct Draw {
    Vec3 direction;
    float weight, pdf;
  };
  std::array<Draw, kMostSamples> draws;
  std::size_t count = 0;
  float peak = 0, total = 0;
  samples = std::min(samples, kMostSamples);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const FixedNumbers numbers = fixed_numbers(i, samples);
    const auto drawn = scattering.sample(numbers.choice, numbers.u, EventMask::smooth);
    if (!drawn || !(mean(drawn->weight) > 0)) continue;
    draws[count++] = {drawn->direction, mean(drawn->weight), drawn->pdf};
    peak = std::max(peak, drawn->pdf);
    total += mean(drawn->weight);
  }
  // What is about as likely as the most likely direction is one lobe, the rest another.
  constexpr float kTail = 0.1f;
  std::array<Heap, 2> heaps;
  for (std::size_t i = 0; i < count; ++i) {
    heaps[draws[i].pdf < kTail * peak ? 1 : 0].add(draws[i].direction, draws[i].weight);
  }
  ScatteringLobes result;
  for (const Heap& heap : heaps) {
    const Factor lobe = heap.lobe(total);
    if (lobe.kappa > 0) result.lobes[result.count++] = lobe;
  }
  return result;
}

}  // namespace pharos::vmf

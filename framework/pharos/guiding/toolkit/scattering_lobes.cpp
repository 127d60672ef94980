#include <algorithm>
#include <cmath>

#include <pharos/guiding/toolkit/scattering_lobes.h>
#include <pharos/statistics/von_mises_fisher.h>

namespace pharos {
namespace {

constexpr float kMostKappa = 1e4f;
/// Fewer directions do not determine a lobe.
constexpr int kFewest = 3;

/// Sums over the directions that form a lobe.
struct Heap {
  Vec3 resultant;
  float weight = 0;
  int count = 0;

  void add(const Heap& other) {
    resultant = resultant + other.resultant;
    weight += other.weight;
    count += other.count;
  }
  ScatteringLobe lobe(float total) const {
    const float size = length(resultant);
    // Directions are closer to their own mean than to the mean of their distribution. The factor
    // n / (n - 1) corrects this.
    const auto n = static_cast<float>(count);
    const float apart = std::min(1.0f, (1 - size / weight) * n / (n - 1));
    const float kappa = (1 - apart) * (3 - square(1 - apart)) / (apart * (2 - apart));
    const float bounded = std::clamp(kappa, von_mises_fisher::kLeastKappa, kMostKappa);
    const auto mode = static_cast<float>(von_mises_fisher::mode_density(bounded));
    return {resultant / size, bounded, mode * weight / total};
  }
};

/// Point i of a fixed set in three dimensions: equal steps in the first one, and a rank-1 lattice
/// by the plastic number in the others.
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

ScatteringLobes fit_scattering(const LocalScattering& scattering, const ScatteringFit& rule) {
  struct Draw {
    Heap heap;  // of this direction alone
    float pdf;
  };
  std::array<Draw, kMostScatteringSamples> draws;
  std::size_t count = 0;
  float peak = 0;
  Heap all;
  for (std::uint32_t i = 0; i < rule.bsdf_samples; ++i) {
    const FixedNumbers numbers = fixed_numbers(i, rule.bsdf_samples);
    const auto drawn = scattering.sample(numbers.choice, numbers.u, EventMask::smooth);
    if (!drawn || !(mean(drawn->weight) > 0)) continue;
    const float weight = mean(drawn->weight);
    draws[count] = {{weight * drawn->direction, weight, 1}, drawn->pdf};
    peak = std::max(peak, drawn->pdf);
    all.add(draws[count++].heap);
  }
  std::array<Heap, 2> heaps;
  for (std::size_t i = 0; i < count; ++i) {
    heaps[draws[i].pdf < rule.bsdf_tail * peak ? 1 : 0].add(draws[i].heap);
  }
  ScatteringLobes result;
  const auto append = [&](const Heap& heap) {
    const bool is_lobe = heap.count >= kFewest && length_squared(heap.resultant) > 0;
    if (is_lobe) result.lobes[result.count++] = heap.lobe(all.weight);
  };
  if (heaps[0].count >= kFewest && heaps[1].count >= kFewest) {
    for (const Heap& heap : heaps) append(heap);
  } else {
    append(all);
  }
  return result;
}

Vec3 normal_towards_path(const GuidingQuery& query) {
  const Vec3 n = query.current.shading_normal;
  return dot(n, query.towards_previous) < 0 ? -n : n;
}

bool is_opaque_surface(const GuidingQuery& query) {
  return query.current.kind == VertexKind::surface &&
         !contains(query.scattering->events(), Event::smooth_transmit);
}

}  // namespace pharos

#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/values.h>
#include <pharos/transport/estimator_rules.h>

namespace pharos {

/// Faults that are planted into the integrators, to see which tests notice them.
enum class PlantedFault {
  none,
  mis_without_guide,            ///< emission is weighted with the unguided density alone
  zero_samples_dropped,         ///< paths of value zero do not count in the average
  light_choice_forgotten,       ///< next event estimation omits the probability of its light
  roulette_unweighted,          ///< survivors of roulette do not represent the terminated paths
  distance_density_forgotten,   ///< steps in media omit the density of their distance
  boundaries_cast_shadows,      ///< neither light samples nor views get through boundaries of media
  boundaries_count_as_origins,  ///< MIS weights take the last boundary as the origin of steps that
                                ///< reach light, and omit the density of distances
  camera_cosine_forgotten,      ///< emitting surfaces seen from the lens are not foreshortened
  reverse_density_forgotten,    ///< MIS weights of paths from the lens ignore light paths
  pixel_shares_forgotten,       ///< paths from the lens are weighted as if pixels had even shares
  shares_forgotten,             ///< MIS weights of emission omit the shares of the techniques
  shares_learned_too_early,     ///< a step is weighted by shares that were learned from it
  resampling_unweighted,        ///< steps chosen among candidates do not represent the others
  branches_unweighted,     ///< each branch, and each light sample, counts like an undivided one
  branches_share_numbers,  ///< all branches of a path have the same random numbers
};
template <>
struct EnumNames<PlantedFault> {
  static constexpr auto names = std::to_array<EnumName<PlantedFault>>(
      {{"none", PlantedFault::none},
       {"mis_without_guide", PlantedFault::mis_without_guide},
       {"zero_samples_dropped", PlantedFault::zero_samples_dropped},
       {"light_choice_forgotten", PlantedFault::light_choice_forgotten},
       {"roulette_unweighted", PlantedFault::roulette_unweighted},
       {"distance_density_forgotten", PlantedFault::distance_density_forgotten},
       {"boundaries_cast_shadows", PlantedFault::boundaries_cast_shadows},
       {"boundaries_count_as_origins", PlantedFault::boundaries_count_as_origins},
       {"camera_cosine_forgotten", PlantedFault::camera_cosine_forgotten},
       {"reverse_density_forgotten", PlantedFault::reverse_density_forgotten},
       {"pixel_shares_forgotten", PlantedFault::pixel_shares_forgotten},
       {"shares_forgotten", PlantedFault::shares_forgotten},
       {"shares_learned_too_early", PlantedFault::shares_learned_too_early},
       {"resampling_unweighted", PlantedFault::resampling_unweighted},
       {"branches_unweighted", PlantedFault::branches_unweighted},
       {"branches_share_numbers", PlantedFault::branches_share_numbers}});
};

/// The current fault, set before a render.
inline PlantedFault planted_fault = PlantedFault::none;
inline bool planted(PlantedFault fault) {
  return planted_fault == fault;
}

/// Returns the position of the last boundary that a step from `from` to `to` passes, or `from` if
/// there is none.
inline Point3 last_boundary(const Scene& scene, Point3 from, const SurfacePoint& to) {
  Point3 last = from;
  for (;;) {
    const Vec3 direction = normalize(to.position - last);
    const Ray ray{last + 1e-3f * direction, direction};
    SurfacePoint at;
    if (std::isinf(scene.intersect(ray, at)) || !scene.is_boundary(at)) return last;
    last = at.position;
  }
}

/// A tracer of segments with the planted fault.
class FaultyTracer {
 public:
  FaultyTracer(const Scene& scene, RenderCounters& counters)
      : scene_(scene), right_(scene, counters) {}

  bool trace(const Ray& ray, const Medium* medium, const ScatterStep& step, Rgb throughput,
             const VertexStream& numbers, Segment& segment, SurfacePoint& end) const {
    const bool arrives = right_.trace(ray, medium, step, throughput, numbers, segment, end);
    if (planted(PlantedFault::distance_density_forgotten)) segment.passage.medium_density = 1;
    return arrives;
  }
  bool pass(const Ray& ray, const Medium* medium, Rgb throughput, Passage& passage) const {
    if (planted(PlantedFault::boundaries_cast_shadows) && scene_.occluded(ray)) return false;
    return right_.pass(ray, medium, throughput, passage);
  }

 private:
  const Scene& scene_;
  SegmentTracer right_;
};

/// The formulas of the estimators. The planted fault replaces one of them.
struct FaultyRules : EstimatorRules {
  using Tracer = FaultyTracer;

  static bool keeps(Rgb value) {
    return !(planted(PlantedFault::zero_samples_dropped) && is_black(value));
  }
  static float light_sample_pdf(float pdf, float probability) {
    return planted(PlantedFault::light_choice_forgotten) ? pdf : pdf * probability;
  }
  static float light_sample_weight(MisHeuristic heuristic, float light_pdf, StepDensity step,
                                   float medium_density) {
    if (planted(PlantedFault::boundaries_count_as_origins)) step.total /= medium_density;
    return EstimatorRules::light_sample_weight(heuristic, light_pdf, step, medium_density);
  }
  static float emission_weight(MisHeuristic heuristic, const Path& path, float light_pdf) {
    float own = path.arrival.total;
    if (planted(PlantedFault::mis_without_guide)) own = path.arrival.unguided;
    if (planted(PlantedFault::shares_forgotten) && path.arrival.guided > 0) {
      own = (path.arrival.unguided + path.arrival.guided) / 2;
    }
    if (planted(PlantedFault::boundaries_count_as_origins)) own /= path.medium_density;
    return pharos::emission_weight(heuristic, own, light_pdf);
  }
  static Point3 light_sample_origin(const Scene& scene, Point3 from, const SurfacePoint& to) {
    return planted(PlantedFault::boundaries_count_as_origins) ? last_boundary(scene, from, to)
                                                              : from;
  }
  static float survivor_weight(float survival) {
    return planted(PlantedFault::roulette_unweighted) ? 1 : 1 / survival;
  }
  static float branch_weight(float factor) {
    return planted(PlantedFault::branches_unweighted) ? 1 : EstimatorRules::branch_weight(factor);
  }
  static VertexStream copy_numbers(const VertexStream& numbers, std::uint32_t copy) {
    return planted(PlantedFault::branches_share_numbers)
               ? numbers
               : EstimatorRules::copy_numbers(numbers, copy);
  }
  static std::uint64_t branch_seed(std::uint64_t seed, std::uint32_t branch) {
    return planted(PlantedFault::branches_share_numbers)
               ? seed
               : EstimatorRules::branch_seed(seed, branch);
  }
  static float foreshortening(float cosine) {
    return planted(PlantedFault::camera_cosine_forgotten) ? 1 : cosine;
  }
  static float drawn_density(const StepDensity& step, float unguided_share) {
    if (!planted(PlantedFault::shares_learned_too_early) || !(step.guided > 0)) return step.total;
    // A step along the gradient of the logarithm of the density with respect to the share.
    constexpr float kRate = 0.1f;
    const float gradient = (step.unguided - step.guided) / step.total;
    const float share = std::clamp(unguided_share + kRate * gradient, 0.05f, 0.95f);
    return share * step.unguided + (1 - share) * step.guided;
  }
  static float resampling_weight(float weight) {
    return planted(PlantedFault::resampling_unweighted) ? 1 : weight;
  }
  static double first_density(double density, double share) {
    return planted(PlantedFault::pixel_shares_forgotten)
               ? density
               : EstimatorRules::first_density(density, share);
  }
  static double reverse_density(double density) {
    return planted(PlantedFault::reverse_density_forgotten) ? 0 : density;
  }
};

}  // namespace pharos

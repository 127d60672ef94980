#pragma once

#include <cstdint>

#include <pharos/core/random.h>
#include <pharos/scene/scene.h>
#include <pharos/transport/path.h>
#include <pharos/transport/path_settings.h>
#include <pharos/transport/segment.h>

namespace pharos {

/// The formulas that make the estimators of light transport unbiased, one function each. Walks take
/// them as a template parameter. Tests can thus replace single formulas by wrong ones and see which
/// other tests detect the fault.
struct EstimatorRules {
  using Tracer = SegmentTracer;

  /// Returns whether a path of this value counts. All paths do, including paths of value zero.
  static bool keeps(Rgb) { return true; }

  /// Returns the density of a light sample in the measure of `pdf`. Its light was chosen with
  /// probability `probability`.
  static float light_sample_pdf(float pdf, float probability) { return pdf * probability; }

  /// Returns the MIS weight [1] of a light sample of density `light_pdf` that a step of density
  /// `step` could have hit (Veach 1997, eq. 9.8 and 9.13).
  static float light_sample_weight(MisHeuristic heuristic, float light_pdf, const StepDensity& step,
                                   float /*medium_density*/) {
    return pharos::light_sample_weight(heuristic, light_pdf, step.total);
  }

  /// Returns the MIS weight [1] of emission that a path has hit, if light samples find it with
  /// density `light_pdf`.
  static float emission_weight(MisHeuristic heuristic, const Path& path, float light_pdf) {
    return pharos::emission_weight(heuristic, path.arrival.total, light_pdf);
  }

  /// Returns the point from which a light sample of the emission at `to` would have been taken, if
  /// a step from `from` has hit the emission.
  static Point3 light_sample_origin(const Scene&, Point3 from, const SurfacePoint& /*to*/) {
    return from;
  }

  /// Returns the factor that compensates for Russian roulette with this probability of survival.
  static float survivor_weight(float survival) { return 1 / survival; }

  /// Returns the weight of each step from a vertex where a path takes `factor` steps on average, or
  /// of each light sample where it takes `factor` light samples on average.
  static float branch_weight(float factor) { return 1 / factor; }

  /// Returns the random numbers of step or light sample `copy` where a vertex has several. Copy 0
  /// has `numbers`.
  static VertexStream copy_numbers(const VertexStream& numbers, std::uint32_t copy) {
    return numbers.copy(copy);
  }

  /// Returns the seed of the random numbers of a branch, from its next vertex on. The path from
  /// which it has split has the seed `seed`.
  static std::uint64_t branch_seed(std::uint64_t seed, std::uint32_t branch) {
    return hash_combine(seed, branch);
  }

  /// Returns the density by which the weight of a step is divided. The step was drawn from a
  /// mixture with this share of unguided samples.
  static float drawn_density(const StepDensity& step, float /*unguided_share*/) {
    return step.total;
  }

  /// Returns the factor that makes up for the choice among candidates; see sample_resampled_step().
  static float resampling_weight(float weight) { return weight; }

  /// Returns the foreshortening factor of a light that the lens sees, for the cosine at the light.
  static float foreshortening(float cosine) { return cosine; }

  /// Returns the density of the first step of a path from the lens to a pixel of this share, if a
  /// pixel of share 1 has `density`.
  static double first_density(double density, double share) { return density * share; }

  /// Returns the density with which a path from the other end would take the same step.
  static double reverse_density(double density) { return density; }
};

}  // namespace pharos

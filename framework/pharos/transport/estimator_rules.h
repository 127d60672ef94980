#pragma once

#include <pharos/scene/scene.h>
#include <pharos/transport/path.h>
#include <pharos/transport/path_settings.h>
#include <pharos/transport/segment.h>

namespace pharos {

/// The formulas that make the estimators of light transport unbiased, one function each. Walks take
/// them as a template parameter: tests replace single formulas by wrong ones, to see which tests
/// notice.
struct EstimatorRules {
  using Tracer = SegmentTracer;

  /// Whether a path of this value counts: all do, those of value zero included.
  static bool keeps(Rgb) { return true; }

  /// The density of a light sample whose light was chosen with `probability`, in the measure of
  /// `pdf`.
  static float light_sample_pdf(float pdf, float probability) { return pdf * probability; }

  /// The MIS weight [1] of a light sample of density `light_pdf` that a step of density `step`
  /// could have hit (Veach 1997, eq. 9.8 and 9.13).
  static float light_sample_weight(MisHeuristic heuristic, float light_pdf, const StepDensity& step,
                                   float /*medium_density*/) {
    return pharos::light_sample_weight(heuristic, light_pdf, step.total);
  }

  /// The MIS weight [1] of emission that a path ran into, if light samples find it with density
  /// `light_pdf`.
  static float emission_weight(MisHeuristic heuristic, const Path& path, float light_pdf) {
    return pharos::emission_weight(heuristic, path.arrival.total, light_pdf);
  }

  /// The point that a light sample of the emission at `to` would have been taken from, when a step
  /// from `from` ran into it.
  static Point3 light_sample_origin(const Scene&, Point3 from, const SurfacePoint& /*to*/) {
    return from;
  }

  /// The factor that makes up for Russian roulette with this probability of survival.
  static float survivor_weight(float survival) { return 1 / survival; }

  /// The factor by which the cosine at a light foreshortens it, when the lens sees it.
  static float foreshortening(float cosine) { return cosine; }

  /// The density with which a path from the other end would make the same step.
  static double reverse_density(double density) { return density; }
};

}  // namespace pharos

#pragma once

#include <optional>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/scene/local_scattering.h>

namespace pharos {

/// A sampled step from a vertex, before it is traced.
struct ScatterStep {
  Vec3 direction;
  Event event = Event::none;
  Rgb value;               ///< f |cos| [1/sr] (volume: [1/(sr m)]), or share [1] if discrete
  float unguided_pdf = 0;  ///< density of the BSDF or phase function [1/sr], or probability [1]
  Rgb unguided_weight;     ///< value / unguided_pdf
  float continuation = 1;  ///< compensates for Russian roulette; a factor of the step's weight
  float resampling = 1;    ///< weight of the choice among candidates; a factor, too
  Proposal::Reach reach = Proposal::Reach::medium;
  float distance = 0;  ///< used with Reach::distance [scene units]
  TargetMask targets = TargetMask::all;
  const Bounds3* within = nullptr;  ///< box in which the next vertex must lie; null: anywhere

  /// Returns whether a next vertex of this kind and position was proposed.
  bool accepts(VertexKind kind, Point3 position) const {
    return is_target(targets, within, kind, position);
  }
};

/// The densities of a step once its next vertex is known.
struct StepDensity {
  float unguided = 0;      ///< of the unguided sampler, including the medium's factor
  float guided = 0;        ///< of the guides, including the medium's factor
  float total = 0;         ///< of the mixture from which the step was drawn
  PartDensities of_parts;  ///< of each part of the guidance
};

// Functions fill in steps and densities in place. A copy reads at once what was written in parts,
// which stalls the walks: moving steps out of optionals takes 5 % of all time.

/// Fills in a step drawn from the BSDF or phase function. Returns false for a valid sample of value
/// zero.
inline bool sample_unguided_step(const LocalScattering& scattering, const VertexStream& stream,
                                 ScatterStep& step) {
  const std::optional<ScatterSample> sample = scattering.sample(
      stream.get_1d(Purpose::bsdf_choice), stream.get_2d(Purpose::bsdf_direction));
  if (!sample || sample->pdf <= 0) return false;
  step.direction = sample->direction;
  step.event = sample->event;
  step.value = sample->pdf * sample->weight;
  step.unguided_pdf = sample->pdf;
  step.unguided_weight = sample->weight;
  step.reach = Proposal::Reach::medium;
  step.targets = TargetMask::all;
  step.within = nullptr;
  step.continuation = step.resampling = 1;
  return true;
}

/// Fills in a step that the guides propose. `u` is the number that has decided for the guides.
/// Returns false for a valid sample of value zero.
bool sample_guided_step(const LocalScattering& scattering, const Guidance& guidance,
                        const VertexStream& stream, float u, ScatterStep& step);

/// Fills in a step that is resampled among `guidance.candidates` candidates (Talbot et al. 2005).
/// The candidates x_i are drawn from the mixture of unguided sampling and the guides, of density p,
/// and each technique draws as many as its share says. One is chosen in proportion to
/// t(x_i) / p(x_i), where the target t = mean(f |cos|) * radiance is the integrand as far as the
/// models know it. `step.resampling` becomes the mean of t / p over all candidates, divided by
/// t / p of the chosen one. With this factor the step estimates without bias what a step drawn from
/// p does, so p also serves for MIS. Returns false for a valid sample of value zero.
bool sample_resampled_step(const LocalScattering& scattering, const Guidance& guidance,
                           const VertexStream& stream, ScatterStep& step);

/// Draws the next step at a vertex from the one-sample mixture of unguided sampling (with
/// probability `guidance.unguided_share`) and the guides, or by resampling if there are several
/// candidates. Returns false for a valid sample of value zero.
inline bool sample_step(const LocalScattering& scattering, const Guidance& guidance,
                        const VertexStream& stream, ScatterStep& step) {
  if (guidance.candidates > 1) return sample_resampled_step(scattering, guidance, stream, step);
  const float u = guidance.is_guided() ? stream.get_1d(Purpose::mix_choice) : 0;
  return guidance.guides(u) ? sample_guided_step(scattering, guidance, stream, u, step)
                            : sample_unguided_step(scattering, stream, step);
}

/// Fills in the density of reaching `vertex` by any technique, in the measure of its event and
/// kind. `unguided_pdf` is the unguided sampler's density of its direction, or the probability of
/// its discrete event.
inline void set_step_density(const Guidance& guidance, const ResolvedVertex& vertex,
                             float unguided_pdf, StepDensity& density) {
  density.unguided = unguided_pdf * vertex.medium_density;
  density.guided = 0;
  density.total = density.unguided;
  if (!guidance.is_guided()) return;
  density.guided = guidance.density(vertex, density.of_parts);
  density.total =
      guidance.unguided_share * density.unguided + (1 - guidance.unguided_share) * density.guided;
}

/// Returns what set_step_density() fills in.
inline StepDensity step_density(const Guidance& guidance, const ResolvedVertex& vertex,
                                float unguided_pdf) {
  StepDensity density;
  set_step_density(guidance, vertex, unguided_pdf, density);
  return density;
}

}  // namespace pharos

#pragma once

#include <optional>

#include <pharos/guiding/guiding.h>
#include <pharos/scene/local_scattering.h>

namespace pharos {

/// A sampled step from a vertex, before it is traced.
struct ScatterStep {
  Vec3 direction;
  Event event = Event::none;
  Rgb value;               ///< f |cos| [1/sr] (volume: [1/(sr m)]), or share [1] if discrete
  float unguided_pdf = 0;  ///< of the BSDF or phase function [1/sr], or probability [1]
  Rgb unguided_weight;     ///< value / unguided_pdf
  Proposal::Reach reach = Proposal::Reach::medium;
  float distance = 0;
  TargetMask targets = TargetMask::all;
};

/// The densities of a step once its next vertex is known.
struct StepDensity {
  float unguided = 0;  ///< of the unguided sampler, the medium included
  float guided = 0;    ///< of the guide
  float total = 0;     ///< of the mixture the step was drawn from
};

/// A step of the BSDF or phase function. Empty for a valid sample of value zero.
inline std::optional<ScatterStep> sample_unguided_step(const LocalScattering& scattering,
                                                       const VertexStream& stream) {
  const std::optional<ScatterSample> sample = scattering.sample(
      stream.get_1d(Purpose::bsdf_choice), stream.get_2d(Purpose::bsdf_direction));
  if (!sample || sample->pdf <= 0) return std::nullopt;
  return ScatterStep{.direction = sample->direction,
                     .event = sample->event,
                     .value = sample->pdf * sample->weight,
                     .unguided_pdf = sample->pdf,
                     .unguided_weight = sample->weight};
}

/// A step that the guide proposes. Empty for a valid sample of value zero.
std::optional<ScatterStep> sample_guided_step(const LocalScattering& scattering,
                                              const GuidingDistribution& guide,
                                              const VertexStream& stream);

/// Draws the next step at a vertex from the one-sample mixture of unguided sampling (with
/// probability `guidance.unguided_fraction`) and the guide. Empty for a valid sample of value zero.
inline std::optional<ScatterStep> sample_step(const LocalScattering& scattering,
                                              const Guidance& guidance,
                                              const VertexStream& stream) {
  const bool unguided = guidance.distribution == nullptr ||
                        stream.get_1d(Purpose::mix_choice) < guidance.unguided_fraction;
  return unguided ? sample_unguided_step(scattering, stream)
                  : sample_guided_step(scattering, *guidance.distribution, stream);
}

/// The density of reaching `vertex`, by whichever way, in the measure of its event and kind, when
/// the unguided sampler's density of its direction (or probability of its discrete event) is
/// `unguided_pdf`.
inline StepDensity step_density(const Guidance& guidance, const ResolvedVertex& vertex,
                                float unguided_pdf) {
  StepDensity density;
  density.unguided = unguided_pdf * vertex.medium_density;
  density.total = density.unguided;
  if (guidance.distribution != nullptr) {
    density.guided = guidance.distribution->density(vertex).value;
    density.total = guidance.unguided_fraction * density.unguided +
                    (1 - guidance.unguided_fraction) * density.guided;
  }
  return density;
}

}  // namespace pharos

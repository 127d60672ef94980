#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <pharos/guiding/contract/termination.h>
#include <pharos/transport/estimator_rules.h>
#include <pharos/transport/waiting_paths.h>

namespace pharos {

/// Asks a rule where paths end and split, and draws the number of steps.
template <class Rules = EstimatorRules>
class TerminationChoice {
 public:
  /// `rule` may be null: paths neither end nor split.
  explicit TerminationChoice(const TerminationRule* rule)
      : of_vertex_(rule != nullptr && rule->stage() == TerminationRule::Stage::vertex ? rule
                                                                                      : nullptr),
        of_step_(of_vertex_ == nullptr ? rule : nullptr) {}

  /// Returns how many steps a path takes from its current vertex, as is decided before they are
  /// drawn, and how often it samples lights. At most `most_new` steps may be taken by new branches,
  /// and lights are sampled at most `most_lights` times. `film` is in pixels.
  Branching branching(const Path& path, Vec2 film, const LocalScattering& scattering,
                      std::uint32_t most_new, std::uint32_t most_lights) const {
    if (of_vertex_ == nullptr) return {};
    const TerminationQuery query = query_at(path, film, scattering);
    // The limit is a whole number, so drawn numbers do not exceed it either. Branches of a discrete
    // event would coincide.
    const float limit = query.discrete ? 1 : 1 + static_cast<float>(most_new);
    const BranchFactors asked = of_vertex_->factors(query);
    const bool are_equal = asked.lights == asked.steps;
    const float steps = std::min(asked.steps, limit);
    const float lights =
        std::min(are_equal ? steps : asked.lights, static_cast<float>(most_lights));
    if (steps == 1 && lights == 1) return {};
    // Equal factors give equal numbers, so that each step has a light sample. Different ones are
    // drawn independently, so that roulette does not take away steps and light samples together.
    constexpr std::uint16_t kSteps = 1, kLights = 2;  // branches of Purpose::roulette
    const auto number = [&](float expected, std::uint16_t branch) {
      return whole_number(expected, path.numbers().get_1d(Purpose::roulette, branch));
    };
    return {number(steps, kSteps), Rules::branch_weight(steps),
            number(lights, are_equal ? kSteps : kLights), Rules::branch_weight(lights)};
  }

  /// Plays Russian roulette after a step was drawn. Returns false if the path ends;
  /// `step.continuation` is 0 then.
  bool survives(Path& path, Vec2 film, const LocalScattering& scattering, ScatterStep& step) const {
    if (of_step_ == nullptr) return true;
    const bool refracts =
        step.event == Event::smooth_transmit || step.event == Event::discrete_transmit;
    // Refraction does not change the throughput of paths from lights.
    if (refracts && path.transport == Transport::radiance) note_refraction(path, scattering);
    const float survival = of_step_->factors(query_at(path, film, scattering)).steps;
    if (survival >= 1) return true;
    const bool ends = path.numbers().get_1d(Purpose::roulette) >= survival;
    step.continuation = ends ? 0 : Rules::survivor_weight(survival);
    return !ends;
  }

 private:
  /// Returns floor(factor) or floor(factor) + 1, `factor` on average over `u` in [0, 1).
  static std::uint32_t whole_number(float factor, float u) {
    const float whole = std::floor(factor);
    return static_cast<std::uint32_t>(whole) + (u < factor - whole ? 1u : 0u);
  }

  static TerminationQuery query_at(const Path& path, Vec2 film, const LocalScattering& scattering) {
    return {.film = film,
            .position = path.here().position(),
            .towards_previous = path.towards_previous,
            .bounce = path.bounce,
            .discrete = scattering.purely_discrete(),
            .throughput = path.throughput,
            .first_throughput = path.first_throughput,
            .film_weight = path.film_weight,
            .branches = path.branches,
            .solid_angle_scale = path.solid_angle_scale};
  }

  /// Accounts for refraction. Refraction compresses radiance into a smaller solid angle, and
  /// roulette must not mistake this for a loss of light.
  static void note_refraction(Path& path, const LocalScattering& scattering) {
    const float ratio = square(scattering.bsdf().relative_ior());
    const bool enters = dot(path.towards_previous, path.here().surface.normal) > 0;
    path.solid_angle_scale *= enters ? 1 / ratio : ratio;
  }

  const TerminationRule* of_vertex_;  ///< asked before steps are drawn; null: none
  const TerminationRule* of_step_;    ///< asked after a step was drawn; null: none
};

}  // namespace pharos

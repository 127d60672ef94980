#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/rendering/integrator.h>
#include <pharos/transport/light_selection.h>

namespace pharos {

/// The weighting of light that both light samples and steps can find. `light_samples` counts only
/// light samples, wherever lights can be sampled.
enum class MisHeuristic { balance, power, light_samples };
enum class Roulette { off, throughput };

template <>
struct EnumNames<MisHeuristic> {
  static constexpr auto names =
      std::to_array<EnumName<MisHeuristic>>({{"balance", MisHeuristic::balance},
                                             {"power", MisHeuristic::power},
                                             {"light_samples", MisHeuristic::light_samples}});
};
template <>
struct EnumNames<Roulette> {
  static constexpr auto names = std::to_array<EnumName<Roulette>>(
      {{"off", Roulette::off}, {"throughput", Roulette::throughput}});
};

/// Throws InputError if a termination learns. Only paths from the sensor can teach one.
void check_learns_nothing(const Ref<Termination>& termination);

/// The settings for tracing paths from the sensor.
struct PathSettings {
  std::uint16_t max_depth = 12;
  bool next_event_estimation = true;
  LightSelection light_selection = LightSelection::one;
  MisHeuristic mis = MisHeuristic::balance;
  Roulette roulette = Roulette::off;
  std::uint16_t roulette_depth = 5;
  float roulette_limit = 0.95f;
  Ref<Termination> termination;  ///< null: as the settings of roulette say
  std::uint32_t most_branches = 1000;
  /// Limit of the vertices and light samples in the log of a work unit; see
  /// PathLog::set_most_records(). The unit has 4,096 paths if its tile has the default size.
  std::uint32_t most_records = 1'000'000;
  std::optional<GuidingSettings> guiding;
  std::optional<TrainingSettings> training;

  static void describe(Schema<PathSettings>& schema);

  /// Returns the rule by which paths end and split as long as nothing is learned; null: they
  /// neither end nor split.
  std::shared_ptr<const TerminationRule> first_rule() const;
  /// Returns how a render trains what it learns, as the guides or, if they do not learn, `training`
  /// say; null: nothing learns.
  const TrainingSettings* training_of_all() const;
  /// Throws InputError if settings contradict each other.
  void check() const;
};

/// Returns the MIS weight [1] of a technique of density `own` against one of density `other`. Both
/// densities are in the same measure (Veach 1997, eq. 9.8 and 9.13 with exponent 2).
inline float mis_weight(float own, float other, bool squared) {
  if (!squared) return own / (own + other);
  const float ratio = other / own;  // squares of large densities overflow, their ratio does not
  return 1 / (1 + ratio * ratio);
}

/// Returns the MIS weight [1] of a light sample of density `own` that a step of density `step`
/// could have hit.
inline float light_sample_weight(MisHeuristic heuristic, float own, float step) {
  if (heuristic == MisHeuristic::light_samples) return 1;
  return mis_weight(own, step, heuristic == MisHeuristic::power);
}

/// Returns the MIS weight [1] of light that a step of density `own` has hit and that light samples
/// find with density `light`.
inline float emission_weight(MisHeuristic heuristic, float own, float light) {
  if (heuristic == MisHeuristic::light_samples) return light > 0 ? 0.0f : 1.0f;
  return mis_weight(own, light, heuristic == MisHeuristic::power);
}

}  // namespace pharos

#include <pharos/core/error.h>
#include <pharos/guiding/toolkit/throughput_roulette.h>
#include <pharos/transport/path_settings.h>

namespace pharos {

void check_learns_nothing(const Ref<Termination>& termination) {
  if (termination == nullptr || !termination->learns()) return;
  throw InputError("the termination '" + termination->plugin_name() +
                   "' learns, which only the integrator 'path' offers");
}

void PathSettings::describe(Schema<PathSettings>& s) {
  s.field("max_depth", &PathSettings::max_depth,
          "Length of the longest path: 1 shows only emitters, 2 adds direct light")
      .unit("segments")
      .at_least(1);
  s.field("next_event_estimation", &PathSettings::next_event_estimation,
          "Sample lights at every vertex");
  s.field("light_selection", &PathSettings::light_selection,
          "Lights that are sampled at each vertex: one, chosen in proportion to power, or all");
  s.field("mis", &PathSettings::mis,
          "MIS heuristic for light that both light samples and steps can find; light_samples "
          "counts only light samples, wherever lights can be sampled");
  s.field("roulette", &PathSettings::roulette,
          "Russian roulette: off, or with the throughput as survival probability");
  s.field("roulette_depth", &PathSettings::roulette_depth,
          "Number of the first vertex at which roulette is played");
  s.field("roulette_limit", &PathSettings::roulette_limit, "Largest survival probability")
      .above(0)
      .at_most(1);
  s.field("termination", &PathSettings::termination,
          "Where paths end by Russian roulette and where they split, instead of `roulette`");
  s.field(
       "most_branches", &PathSettings::most_branches,
       "Largest number of branches that may split off a path; beyond it, the path does not split")
      .at_most(100'000);
  s.field("most_records", &PathSettings::most_records,
          "Number of recorded vertices and light samples of a work unit from which on its further "
          "paths are not recorded, which limits the memory")
      .at_least(1);
  s.field("guiding", &PathSettings::guiding, "Path guiding: what is learned and how it is used");
  s.field(
      "training", &PathSettings::training,
      "How the budget is divided between training and the final image if the termination learns "
      "and no guide does; if guides learn, the training of `guiding` serves both");
}

std::shared_ptr<const TerminationRule> PathSettings::first_rule() const {
  if (termination != nullptr) return termination->begin({})->rule();
  if (roulette == Roulette::off) return nullptr;
  return std::make_shared<ThroughputRoulette>(roulette_depth, roulette_limit);
}

const TrainingSettings* PathSettings::training_of_all() const {
  static const TrainingSettings defaults;
  if (guiding && guiding->learns()) return &guiding->training;
  if (termination == nullptr || !termination->learns()) return nullptr;
  return training ? &*training : &defaults;
}

void PathSettings::check() const {
  if (termination != nullptr && roulette != Roulette::off) {
    throw InputError("there is a 'termination', so 'roulette' must be off");
  }
  if (training && training_of_all() != &*training) {
    throw InputError(guiding && guiding->learns()
                         ? "the guides learn, so 'training' belongs under 'guiding'"
                         : "there is 'training', but nothing learns");
  }
  if (training && training->puts_guides_on_trial()) {
    throw InputError(
        "no guide learns, so 'training' cannot have 'tolerance', 'least_gain' or 'least_part'");
  }
}

}  // namespace pharos

#include <pharos/transport/path_settings.h>

namespace pharos {

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
  s.field("guiding", &PathSettings::guiding, "Path guiding: what is learned and how it is used");
}

}  // namespace pharos

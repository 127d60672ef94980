#include <pharos/transport/path_settings.h>

namespace pharos {

void PathSettings::describe(Schema<PathSettings>& s) {
  s.field("max_depth", &PathSettings::max_depth,
          "Longest path: 1 sees emitters only, 2 adds direct light")
      .unit("segments")
      .at_least(1);
  s.field("next_event_estimation", &PathSettings::next_event_estimation,
          "Sample lights at every vertex");
  s.field("light_selection", &PathSettings::light_selection,
          "Which lights a vertex samples: one in proportion to power, or all");
  s.field(
      "mis", &PathSettings::mis,
      "How light found by sampling lights and by running into them is weighted; light_samples: the "
      "former alone, wherever lights can be sampled");
  s.field("roulette", &PathSettings::roulette,
          "Russian roulette: off, or with the throughput as survival probability");
  s.field("roulette_depth", &PathSettings::roulette_depth, "Vertex from which roulette is played");
  s.field("roulette_limit", &PathSettings::roulette_limit, "Largest survival probability")
      .above(0)
      .at_most(1);
  s.field("guiding", &PathSettings::guiding, "What is learned and how it is used");
}

}  // namespace pharos

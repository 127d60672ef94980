// throughput: Russian roulette with the throughput of the path as probability of survival, from the
// vertex number `depth` on (Arvo and Kirk 1990, "Particle Transport and Image Synthesis"):
//
//     q = min(limit, max(T) s / max(T_1)).
//
// T is the throughput up to the vertex, T_1 the throughput after the first step. The factor s
// makes up for the compression of radiance by refraction, which is no loss of light. Paths do not
// split.
//
//     termination: { type: throughput, depth: 5, limit: 0.95 }
#include "throughput.h"

#include <pharos/guiding/toolkit/throughput_roulette.h>

namespace pharos {

void ThroughputTermination::Settings::describe(Schema<Settings>& s) {
  s.field("depth", &Settings::depth, "Number of the first vertex at which roulette is played");
  s.field("limit", &Settings::limit, "Largest probability of survival").above(0).at_most(1);
}

std::shared_ptr<const TerminationRule> ThroughputTermination::Settings::rule() const {
  return std::make_shared<ThroughputRoulette>(depth, limit);
}

std::unique_ptr<TerminationState> ThroughputTermination::begin(const LearningContext&) const {
  return std::make_unique<FixedTermination>(settings_.rule());
}

}  // namespace pharos

// none: paths neither end before their largest depth nor split.
//
//     termination: { type: none }
#include "none.h"

#include <pharos/guiding/toolkit/throughput_roulette.h>

namespace pharos {

std::unique_ptr<TerminationState> NoTermination::begin(const LearningContext&) const {
  return std::make_unique<FixedTermination>(nullptr);
}

}  // namespace pharos

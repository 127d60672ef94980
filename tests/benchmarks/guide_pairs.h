#pragma once

#include <string>
#include <vector>

#include <pharos/config/registry.h>

namespace pharos::bench {

/// A learner and a guider of the same model, with their defaults or, where they have none, the
/// first example they state.
struct GuidePair {
  std::string name;             ///< of both plugins, or "learner+guider" where names differ
  std::string learner, guider;  ///< settings with `type` on one line
};

/// Every pair of the registry.
std::vector<GuidePair> guide_pairs(const Registry& registry);

}  // namespace pharos::bench

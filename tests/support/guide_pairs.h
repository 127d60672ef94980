#pragma once

#include <string>
#include <vector>

#include <pharos/config/registry.h>

namespace pharos::testing {

/// A learner and a guider with the same kind of model. They use their defaults or, if they have
/// none, the first example that they declare.
struct GuidePair {
  std::string name;             ///< of both plugins, or "learner+guider" if the names differ
  std::string learner, guider;  ///< settings with `type`, on one line
};

/// Returns every pair of the registry.
std::vector<GuidePair> guide_pairs(const Registry& registry);

}  // namespace pharos::testing

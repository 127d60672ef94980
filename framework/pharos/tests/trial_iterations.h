#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <pharos/guiding/pipeline/guiding_state.h>

#include "two_directions.h"

namespace pharos::test {

/// Ends an iteration of paths that guides have drawn. Returns whether training may end.
inline bool may_end(GuidingState& state, std::span<const double> guides, const IterationCost& cost,
                    std::uint64_t seed) {
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    state.absorb(guided_paths(guides, 1000, 100 * seed + unit));
  }
  return state.may_end_training(cost);
}
inline bool may_end(GuidingState& state, std::span<const double> guides, double spent,
                    std::uint64_t seed) {
  return may_end(state, guides, IterationCost{.spent = spent}, seed);
}
inline bool may_end(GuidingState& state, double guide, double spent, std::uint64_t seed) {
  return may_end(state, std::array{guide}, spent, seed);
}

}  // namespace pharos::test

#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/mixing.h>

#include "finds.h"

namespace pharos {

/// See simplex.cpp.
class SimplexMixing final : public MixingPolicy {
 public:
  struct Settings {
    MixingObjective objective = MixingObjective::variance;
    double unguided = 0.75;
    double least = 0.1;
    double explore = 0.05;
    double worth = 1.2;
    double prior_steps = 8;
    double decay = 0.25;
    float evidence = 32;
    std::uint32_t cell_steps = 8192;
    std::uint32_t reservoir = 1024;
    static constexpr std::uint32_t kMostSteps = 4096;  ///< largest `reservoir`
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if `unguided` is less than `least`, or `least` and `explore` leave no room.
  explicit SimplexMixing(const Settings& settings);

  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override;

 private:
  Settings settings_;
};

}  // namespace pharos

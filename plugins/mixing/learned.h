#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/mixing.h>

#include "finds.h"

namespace pharos {

/// See learned.cpp.
class LearnedMixing final : public MixingPolicy {
 public:
  struct Settings {
    MixingObjective objective = MixingObjective::kl;
    double initial = 0.5;
    double least = 0.05;
    double learning_rate = 0.01;
    double mean_decay = 0.9;
    double square_decay = 0.999;
    double epsilon = 1e-8;
    double regularization = 0.01;
    std::uint32_t batch = 2;
    std::uint32_t steps = 500;
    std::uint32_t bins = 32;
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if `initial` is not in [least, 1 - least].
  explicit LearnedMixing(const Settings& settings);

  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override;

 private:
  Settings settings_;
};

}  // namespace pharos

#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include <pharos/guiding/contract/termination.h>

namespace pharos {

/// Russian roulette by the throughput: a path survives with the probability
///
///     q = min(limit, max(T) s / max(T_1)),
///
/// where T is the throughput, T_1 the throughput after the first step, and s makes up for the
/// compression of radiance by refraction, which is no loss of light.
class ThroughputRoulette final : public TerminationRule {
 public:
  /// Roulette is played from the vertex number `depth` on.
  ThroughputRoulette(std::uint16_t depth, float limit) : depth_(depth), limit_(limit) {}

  /// The step may refract, and refraction changes the probability.
  Stage stage() const override { return Stage::step; }
  BranchFactors factors(const TerminationQuery& query) const override {
    if (query.bounce < depth_) return {};
    const float value =
        max_component(query.throughput) * query.solid_angle_scale / query.first_throughput;
    return {.steps = std::min(limit_, value)};
  }

 private:
  std::uint16_t depth_;
  float limit_;
};

/// The state of a termination that learns nothing.
class FixedTermination final : public TerminationState {
 public:
  explicit FixedTermination(std::shared_ptr<const TerminationRule> rule) : rule_(std::move(rule)) {}
  void absorb(const PathLog&) override {}
  void update(const TrainingStage&) override {}
  std::shared_ptr<const TerminationRule> rule() const override { return rule_; }
  void archive(Archive&) override {}

 private:
  std::shared_ptr<const TerminationRule> rule_;
};

}  // namespace pharos

// fixed: the share of unguided samples is the same everywhere and always. A share of 1 turns
// guiding off.
//
//     { type: fixed, unguided_fraction: 0.5 }
#include "fixed.h"

namespace pharos {
namespace {

class ConstantShares final : public MixingShares {
 public:
  ConstantShares(float unguided, std::span<const float> weights)
      : unguided_(unguided), weights_(weights.begin(), weights.end()) {}
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    share_by_weight(weights_, query.places, unguided_, shares);
    return 0;
  }

 private:
  float unguided_;
  std::vector<float> weights_;
};

/// There is nothing to learn and nothing to save.
class FixedState final : public MixingState {
 public:
  FixedState(float unguided, std::span<const float> weights)
      : shares_(std::make_shared<const ConstantShares>(unguided, weights)) {}
  void absorb(const PathLog&) override {}
  void update(std::uint32_t, std::span<const std::uint32_t>, bool) override {}
  std::shared_ptr<const MixingShares> shares() const override { return shares_; }
  void archive(Archive&) override {}

 private:
  std::shared_ptr<const MixingShares> shares_;
};

}  // namespace

void FixedMixing::Settings::describe(Schema<Settings>& s) {
  s.field("unguided_fraction", &Settings::unguided_fraction, "Share of unguided samples")
      .above(0)
      .at_most(1);
}

std::unique_ptr<MixingState> FixedMixing::begin(std::span<const float> weights) const {
  return std::make_unique<FixedState>(unguided_fraction_, weights);
}

}  // namespace pharos

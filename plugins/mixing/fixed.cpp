// fixed: the share of unguided samples is always the same, at all vertices and on the lens. A share
// of 1 turns guiding off.
//
//     { type: fixed, unguided_fraction: 0.5, unguided_camera: 0.75 }
#include "fixed.h"

namespace pharos {
namespace {

class ConstantShares final : public MixingShares {
 public:
  ConstantShares(const FixedMixing::Settings& settings, std::span<const float> weights)
      : unguided_(settings.unguided_fraction),
        unguided_camera_(settings.unguided_camera.value_or(settings.unguided_fraction)),
        weights_(weights.begin(), weights.end()) {}
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const bool is_on_lens = query.vertex.scattering == nullptr;
    share_by_weight(weights_, query.places, is_on_lens ? unguided_camera_ : unguided_, shares);
    return 0;
  }

 private:
  float unguided_, unguided_camera_;
  std::vector<float> weights_;
};

/// There is nothing to learn and nothing to save.
class FixedState final : public MixingState {
 public:
  FixedState(const FixedMixing::Settings& settings, std::span<const float> weights)
      : shares_(std::make_shared<const ConstantShares>(settings, weights)) {}
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
  s.field("unguided_camera", &Settings::unguided_camera,
          "Share of film positions that no guide of the camera chooses; by default "
          "`unguided_fraction`")
      .above(0)
      .at_most(1);
  s.example("{ unguided_camera: 0.75 }");
}

std::unique_ptr<MixingState> FixedMixing::begin(std::span<const float> weights) const {
  return std::make_unique<FixedState>(settings_, weights);
}

}  // namespace pharos

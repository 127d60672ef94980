// fixed: the same share of samples is unguided everywhere and always. A share of 1 turns guiding
// off.
//
//     { type: fixed, unguided_fraction: 0.5 }
#include "fixed.h"

namespace pharos {
namespace {

class ConstantFraction final : public MixingFractions {
 public:
  explicit ConstantFraction(float fraction) : fraction_(fraction) {}
  float unguided_fraction(std::uint32_t) const override { return fraction_; }

 private:
  float fraction_;
};

class FixedState final : public MixingState {
 public:
  explicit FixedState(float fraction)
      : fractions_(std::make_shared<const ConstantFraction>(fraction)) {}
  void absorb(const PathLog&) override {}
  std::shared_ptr<const MixingFractions> update(std::uint32_t,
                                                std::span<const std::uint32_t>) override {
    return fractions_;
  }
  // There is nothing to remember.
  void save(std::ostream&) const override {}
  void load(std::istream&) override {}
  void merge(const MixingState&) override {}

 private:
  std::shared_ptr<const MixingFractions> fractions_;
};

}  // namespace

void FixedMixing::Settings::describe(Schema<Settings>& s) {
  s.field("unguided_fraction", &Settings::unguided_fraction, "Share of unguided samples")
      .above(0)
      .at_most(1);
}

std::unique_ptr<MixingState> FixedMixing::begin() const {
  return std::make_unique<FixedState>(unguided_fraction_);
}

}  // namespace pharos

#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/mixing.h>

namespace pharos {

class FixedMixing final : public MixingPolicy {
 public:
  struct Settings {
    float unguided_fraction = 0.5f;
    static void describe(Schema<Settings>& s);
  };
  explicit FixedMixing(const Settings& settings) : unguided_fraction_(settings.unguided_fraction) {}

  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override;

 private:
  float unguided_fraction_;
};

}  // namespace pharos

#pragma once

#include <optional>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/mixing.h>

namespace pharos {

class FixedMixing final : public MixingPolicy {
 public:
  struct Settings {
    float unguided_fraction = 0.5f;
    std::optional<float> unguided_camera;  ///< none: `unguided_fraction`
    static void describe(Schema<Settings>& s);
  };
  explicit FixedMixing(const Settings& settings) : settings_(settings) {}

  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override;

 private:
  Settings settings_;
};

}  // namespace pharos

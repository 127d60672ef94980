#pragma once

#include <array>
#include <optional>

#include <pharos/config/registry.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// How radiance decreases with the angle to the normal.
enum class EmissionLobe { cosine_power, von_mises_fisher };

template <>
struct EnumNames<EmissionLobe> {
  static constexpr auto names =
      std::to_array<EnumName<EmissionLobe>>({{"cosine_power", EmissionLobe::cosine_power},
                                             {"von_mises_fisher", EmissionLobe::von_mises_fisher}});
};

/// See directional_area.cpp.
class DirectionalAreaEmitter : public Emitter {
 public:
  struct Settings {
    Ref<Texture> radiance = {};
    EmissionLobe lobe = EmissionLobe::cosine_power;
    std::optional<float> exponent = {};
    std::optional<float> concentration = {};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError unless the lobe's own parameter is given and the other lobe's parameter is
  /// not.
  explicit DirectionalAreaEmitter(Settings settings);

  bool needs_shape() const override { return true; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Settings settings_;
};

}  // namespace pharos

#pragma once

#include <array>

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

namespace pharos {

/// How the intensity decreases from the beam's edge to the cutoff.
enum class SpotFalloff {
  linear,  ///< linear in the angle
  smooth   ///< cubic Hermite step in the cosine
};

template <>
struct EnumNames<SpotFalloff> {
  static constexpr auto names = std::to_array<EnumName<SpotFalloff>>(
      {{"linear", SpotFalloff::linear}, {"smooth", SpotFalloff::smooth}});
};

/// See spot.cpp.
class SpotEmitter : public Emitter {
 public:
  struct Settings {
    Rgb intensity{1};
    float cutoff_angle = 20;
    float beam_width = 15;
    SpotFalloff falloff = SpotFalloff::linear;
    Transform to_world = {};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError if the beam is wider than the cutoff.
  explicit SpotEmitter(const Settings& settings);

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Settings settings_;
};

}  // namespace pharos

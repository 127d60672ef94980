#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

namespace pharos {

/// See directional.cpp.
class DirectionalEmitter : public Emitter {
 public:
  struct Settings {
    Rgb irradiance{1};
    Vec3 direction{0, 0, -1};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  explicit DirectionalEmitter(const Settings& settings)
      : irradiance_(settings.scale * settings.irradiance),
        towards_light_(-normalize(settings.direction)) {}

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Rgb irradiance_;
  Vec3 towards_light_;
};

}  // namespace pharos

#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

#include "daylight.h"

namespace pharos {

/// See sun.cpp.
class SunEmitter : public Emitter {
 public:
  struct Settings : DaylightSettings {
    float radius_scale = 1;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError if the sun is below the horizon or given twice, or if to_world does not
  /// preserve angles.
  explicit SunEmitter(const Settings& settings);

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Vec3 towards_sun_;
  Rgb irradiance_;       ///< at normal incidence [W/(m^2 nm)]
  float one_minus_cos_;  ///< for the disk's angular radius; 0 for a single direction
};

}  // namespace pharos

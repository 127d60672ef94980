#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

#include "daylight.h"
#include "latlong_distribution.h"
#include "latlong_image.h"

namespace pharos {

/// See sky.cpp.
class SkyEmitter : public Emitter {
 public:
  struct Settings : DaylightSettings {
    int resolution = 512;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError if the sun is below the horizon or given twice, or if to_world does not
  /// preserve angles.
  explicit SkyEmitter(const Settings& settings);

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Frame axes_;
  LatLongImage image_;
  LatLongDistribution distribution_;
  float scale_;
};

}  // namespace pharos

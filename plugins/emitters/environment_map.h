#pragma once

#include <filesystem>

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

#include "latlong_distribution.h"
#include "latlong_image.h"

namespace pharos {

/// See environment_map.cpp.
class EnvironmentMap : public Emitter {
 public:
  struct Settings {
    std::filesystem::path file;
    Transform to_world = {};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  /// Reads the file. Throws InputError if the file cannot be read, if it contains negative values,
  /// infinity or NaN, or if to_world does not preserve angles.
  explicit EnvironmentMap(const Settings& settings);

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  LatLongImage image_;
  LatLongDistribution distribution_;
  Frame axes_;
  float scale_;
};

}  // namespace pharos

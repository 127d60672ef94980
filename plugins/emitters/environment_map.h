#pragma once

#include <array>
#include <filesystem>

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

#include "latlong_distribution.h"
#include "latlong_image.h"

namespace pharos {

/// How an image shows all directions.
enum class EnvironmentLayout {
  latitude_longitude,  ///< rows are circles of latitude
  equal_area           ///< a square of equal areas, as in pbrt-v4
};

/// See environment_map.cpp.
class EnvironmentMap : public Emitter {
 public:
  struct Settings {
    std::filesystem::path file;
    Transform to_world = {};
    float scale = 1;
    EnvironmentLayout layout = EnvironmentLayout::latitude_longitude;
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

template <>
struct EnumNames<EnvironmentLayout> {
  static constexpr auto names = std::to_array<EnumName<EnvironmentLayout>>(
      {{"latitude_longitude", EnvironmentLayout::latitude_longitude},
       {"equal_area", EnvironmentLayout::equal_area}});
};

}  // namespace pharos

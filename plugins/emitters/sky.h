#pragma once

#include <array>

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

#include "daylight.h"
#include "latlong_distribution.h"
#include "latlong_image.h"

namespace pharos {

/// The models of the clear sky.
enum class SkyModel {
  hosek_wilkie,  ///< Hosek and Wilkie 2012
  preetham       ///< Preetham, Shirley and Smits 1999
};

/// See sky.cpp.
class SkyEmitter : public Emitter {
 public:
  struct Settings : DaylightSettings {
    SkyModel model = SkyModel::hosek_wilkie;
    Rgb ground = Rgb(0.15f);
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

template <>
struct EnumNames<SkyModel> {
  static constexpr auto names = std::to_array<EnumName<SkyModel>>(
      {{"hosek_wilkie", SkyModel::hosek_wilkie}, {"preetham", SkyModel::preetham}});
};

}  // namespace pharos

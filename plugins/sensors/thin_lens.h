#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/core/transform.h>
#include <pharos/scene/sensor.h>

namespace pharos {

enum class ApertureShape { round, square };

template <>
struct EnumNames<ApertureShape> {
  static constexpr auto names = std::to_array<EnumName<ApertureShape>>(
      {{"round", ApertureShape::round}, {"square", ApertureShape::square}});
};

/// See thin_lens.cpp.
class ThinLensSensor : public Sensor {
 public:
  struct Settings {
    Transform to_world = {};
    float fov = 45;
    float aperture_radius = 0.01f;
    float focus_distance = 1;
    ApertureShape aperture = ApertureShape::round;
    static void describe(Schema<Settings>& s);
  };

  explicit ThinLensSensor(const Settings& settings) : settings_(settings) {}

  std::unique_ptr<const PreparedSensor> prepare(int width, int height) const override;
  Point3 position() const override { return settings_.to_world.point({}); }

 private:
  Settings settings_;
};

}  // namespace pharos

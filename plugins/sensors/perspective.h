#pragma once

#include <pharos/config/schema.h>
#include <pharos/core/transform.h>
#include <pharos/scene/sensor.h>

namespace pharos {

/// See perspective.cpp.
class PerspectiveSensor : public Sensor {
 public:
  struct Settings {
    Transform to_world = {};
    float fov = 45;
    static void describe(Schema<Settings>& s);
  };

  explicit PerspectiveSensor(const Settings& settings) : settings_(settings) {}

  std::unique_ptr<const PreparedSensor> prepare(int width, int height) const override;
  Point3 position() const override { return settings_.to_world.point({}); }

 private:
  Settings settings_;
};

}  // namespace pharos

#pragma once

#include <pharos/config/schema.h>
#include <pharos/core/transform.h>
#include <pharos/scene/sensor.h>

namespace pharos {

/// See orthographic.cpp.
class OrthographicSensor : public Sensor {
 public:
  struct Settings {
    Transform to_world = {};
    float width = 2;
    static void describe(Schema<Settings>& s);
  };

  explicit OrthographicSensor(const Settings& settings) : settings_(settings) {}

  std::unique_ptr<const PreparedSensor> prepare(int width, int height) const override;
  bool sees_one_direction() const override { return true; }
  Point3 position() const override { return settings_.to_world.point({}); }

 private:
  Settings settings_;
};

}  // namespace pharos

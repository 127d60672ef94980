#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/emitter.h>

namespace pharos {

/// See point.cpp.
class PointEmitter : public Emitter {
 public:
  struct Settings {
    Rgb intensity{1};
    Point3 position;
    Transform to_world = {};
    float scale = 1;
    static void describe(Schema<Settings>& s);
  };

  explicit PointEmitter(const Settings& settings);

  bool needs_shape() const override { return false; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override;

 private:
  Rgb intensity_;
  Point3 position_;
};

}  // namespace pharos

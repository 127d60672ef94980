#pragma once

#include <pharos/config/schema.h>

#include "triangle_shape.h"

namespace pharos {

/// See box.cpp.
class Box : public TriangleShape {
 public:
  struct Settings {
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  explicit Box(const Settings& settings);
};

}  // namespace pharos

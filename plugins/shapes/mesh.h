#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pharos/config/schema.h>

#include "triangle_shape.h"

namespace pharos {

/// See mesh.cpp.
class Mesh : public TriangleShape {
 public:
  struct Settings {
    std::filesystem::path file = {};
    std::string part = {};
    std::optional<int> shape_index = {};
    Transform to_world = {};
    bool flip_normals = false;
    bool face_normals = false;
    static void describe(Schema<Settings>& s);
  };

  explicit Mesh(const Settings& settings);
};

}  // namespace pharos

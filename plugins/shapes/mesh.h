#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pharos/config/schema.h>

#include "triangle_shape.h"

namespace pharos {

/// The source of a mesh's shading normals.
enum class MeshNormals { file_or_flat, file_or_smooth, flat };
template <>
struct EnumNames<MeshNormals> {
  static constexpr auto names =
      std::to_array<EnumName<MeshNormals>>({{"file_or_flat", MeshNormals::file_or_flat},
                                            {"file_or_smooth", MeshNormals::file_or_smooth},
                                            {"flat", MeshNormals::flat}});
};

/// See mesh.cpp.
class Mesh : public TriangleShape {
 public:
  struct Settings {
    std::filesystem::path file = {};
    std::string part = {};
    std::optional<int> shape_index = {};
    Transform to_world = {};
    bool flip_normals = false;
    MeshNormals normals = MeshNormals::file_or_flat;
    static void describe(Schema<Settings>& s);
  };

  explicit Mesh(const Settings& settings);
};

}  // namespace pharos

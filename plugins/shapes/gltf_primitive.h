#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <pharos/scene/shape.h>

#include "gltf_accessor.h"
#include "node_transform.h"

namespace pharos {

/// Which of the things that not all meshes have a joined mesh has.
struct VertexAttributes {
  bool normals = false, uvs = false;
};

/// How large a joined mesh becomes. In double, as a small file can ask for more than any integer
/// holds.
struct MeshExtent {
  double triangles = 0, vertices = 0;
  VertexAttributes attributes;  ///< that any part of it has

  MeshExtent& operator+=(const MeshExtent& more) {
    triangles += more.triangles;
    vertices += more.vertices;
    attributes.normals |= more.attributes.normals;
    attributes.uvs |= more.attributes.uvs;
    return *this;
  }
};

/// A set of triangles in a glTF mesh: single ones, a strip or a fan. Lives as long as the file.
class GltfPrimitive {
 public:
  /// Throws InputError when what the primitive names is missing, damaged or does not fit together.
  GltfPrimitive(GltfFile& file, const GltfValue& primitive);

  /// What append_to() adds; no triangles for points and lines.
  MeshExtent extent() const;

  /// Adds the triangles as `to_root` places them; the outer side of mirrored ones stays the outer
  /// side. Of `attributes`, those that the primitive lacks are zero. Throws InputError when a
  /// vertex is missing or not finite.
  void append_to(TriangleMesh& mesh, const NodeTransform& to_root,
                 VertexAttributes attributes) const;

 private:
  enum class Mode { points, lines, line_loop, line_strip, triangles, strip, fan };

  static Mode mode_of(const GltfValue& primitive);
  void check() const;
  std::uint64_t corner_count() const { return indices_ ? indices_->size() : positions_.size(); }
  std::uint64_t triangle_count() const;
  /// All vertices but where many primitives share a long list and name few of it: those get the
  /// ones they name, so that there are never more than three a triangle.
  bool takes_all_vertices() const { return positions_.size() <= 3 * triangle_count(); }
  /// The vertices of a triangle, known to exist.
  std::array<std::uint32_t, 3> corners(std::uint64_t triangle) const;
  void append_vertex(TriangleMesh& mesh, std::uint32_t vertex, const NodeTransform& to_root,
                     VertexAttributes attributes) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string place_;
  Mode mode_;
  GltfAccessor positions_;
  std::optional<GltfAccessor> normals_, uvs_, indices_;
};

}  // namespace pharos

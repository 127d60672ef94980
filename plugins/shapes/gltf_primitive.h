#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <pharos/scene/shape.h>

#include "gltf_accessor.h"
#include "node_transform.h"

namespace pharos {

/// The optional attributes that a joined mesh has.
struct VertexAttributes {
  bool normals = false, uvs = false;
};

/// The size of a joined mesh. The counts are doubles, because a small file can request more than
/// any integer type can hold.
struct MeshExtent {
  double triangles = 0, vertices = 0;
  VertexAttributes attributes;  ///< the attributes that any part of it has

  MeshExtent& operator+=(const MeshExtent& more) {
    triangles += more.triangles;
    vertices += more.vertices;
    attributes.normals |= more.attributes.normals;
    attributes.uvs |= more.attributes.uvs;
    return *this;
  }
};

/// A set of triangles in a glTF mesh: a list, a strip or a fan. The file must outlive it.
class GltfPrimitive {
 public:
  /// Throws InputError if data of the primitive is missing, damaged or inconsistent.
  GltfPrimitive(GltfFile& file, const GltfValue& primitive);

  /// Returns the size of what append_to() adds. Points and lines have no triangles.
  MeshExtent extent() const;

  /// Adds the triangles, transformed by `to_root`. The outer side remains the outer side under maps
  /// that mirror. Those of `attributes` that the primitive lacks become zero. Throws InputError if
  /// a vertex is missing or not finite.
  void append_to(TriangleMesh& mesh, const NodeTransform& to_root,
                 VertexAttributes attributes) const;

 private:
  enum class Mode { points, lines, line_loop, line_strip, triangles, strip, fan };

  static Mode mode_of(const GltfValue& primitive);
  void check() const;
  std::uint64_t corner_count() const { return indices_ ? indices_->size() : positions_.size(); }
  std::uint64_t triangle_count() const;
  /// Returns whether all vertices are added. If many primitives share a long list and each uses few
  /// of its vertices, each adds only the vertices that it uses. There are therefore never more than
  /// three vertices per triangle.
  bool takes_all_vertices() const { return positions_.size() <= 3 * triangle_count(); }
  /// Returns the vertices of a triangle, which are known to exist.
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

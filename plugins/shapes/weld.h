#pragma once

#include <pharos/scene/shape.h>

namespace pharos {

/// Returns the same triangles with each vertex stored once. Vertices that agree in every bit of
/// position, normal and texture coordinates become one; vertices that no triangle uses are removed.
/// Readers of some formats create separate vertices for every face. Throws InputError unless the
/// number of normals is zero or equals the number of vertices, and likewise for texture
/// coordinates.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace pharos

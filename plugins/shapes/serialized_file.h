#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// Reads the triangles of a file in Mitsuba's format `serialized`, versions 3 and 4: all meshes,
/// the mesh of number `source.index`, or the meshes of the name `source.part`. Throws InputError,
/// with the number of the mesh, if data is truncated, damaged, not finite or too large, and if
/// there is no such mesh.
TriangleMesh read_serialized(const MeshSource& source);

}  // namespace pharos

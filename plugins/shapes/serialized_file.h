#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// The triangles of a file of Mitsuba's format `serialized`, versions 3 and 4: those of all its
/// meshes, of the one of number `source.index`, or of those of the name `source.part`. Throws
/// InputError, with the number of the mesh, for what is cut off, damaged, not finite or too large,
/// and when there is no such mesh.
TriangleMesh read_serialized(const MeshSource& source);

}  // namespace pharos

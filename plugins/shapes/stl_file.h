#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// The triangles of an STL file, text or binary. The order of the vertices says which side is the
/// outer one; the normals in the file are passed over. Throws InputError for what is cut off, not
/// finite or no STL: with the line in text, with the triangle in binary files.
TriangleMesh read_stl(const MeshSource& source);

}  // namespace pharos

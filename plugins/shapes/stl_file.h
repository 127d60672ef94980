#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// Reads the triangles of an STL file, text or binary. The order of the vertices determines the
/// outer side; the normals in the file are ignored. Throws InputError if the file is truncated, not
/// STL, or has numbers that are not finite. The message gives the line of a text file, or the
/// triangle of a binary file.
TriangleMesh read_stl(const MeshSource& source);

}  // namespace pharos

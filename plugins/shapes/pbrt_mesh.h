#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// Reads the triangles of a directive `Shape` in a scene file of pbrt-v4: a `trianglemesh`, a
/// `bilinearmesh` (two triangles a patch), or the control mesh of a `loopsubdiv`. Normals in
/// the file decide on the outer side of a triangle, as in pbrt. The part is the place "line:column"
/// of the directive in the file. Throws InputError, located in the file, if there is no such
/// directive, for bad syntax, missing or superfluous values, and indices out of range.
TriangleMesh read_pbrt_mesh(const MeshSource& source);

}  // namespace pharos

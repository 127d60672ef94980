#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// Reads the triangles of a Wavefront OBJ file. Its objects (`o`) and groups (`g`) are its parts;
/// an object begins outside all groups. Polygons are assumed to be convex and become triangle fans.
/// Lines, points, materials and smoothing groups are ignored. Throws InputError, located at the
/// faulty word, if a statement is not part of OBJ or describes a free-form surface, if a number is
/// not finite, or if a vertex has not been defined so far. Throws InputError without a location if
/// there is no such part.
TriangleMesh read_obj(const MeshSource& source);

}  // namespace pharos

#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// The triangles of a Wavefront OBJ file. Its objects (`o`) and groups (`g`) are its parts; an
/// object begins outside all groups. Polygons, which are taken to be convex, become fans; lines,
/// points, materials and smoothing groups are passed over. Throws InputError, located at the word
/// that is to blame, for what is no statement of OBJ or one for free-form surfaces, not a finite
/// number, or no vertex so far; without a location when there is no such part.
TriangleMesh read_obj(const MeshSource& source);

}  // namespace pharos

#pragma once

#include <pharos/scene/shape.h>

#include "mesh.h"

namespace pharos {

/// The triangles that a mesh's settings ask for, in world space, with the normals they ask for. The
/// file's meshes are joined, with the transforms of its nodes applied: all of them or, unless
/// `part` is empty, those of that name and all that lies at or below the nodes of that name, or the
/// one of number `shape_index`. Meshes without normals or texture coordinates, where others have
/// them, get zeros. Texture coordinates have their origin at the picture's lower left. Throws
/// InputError with the path when the format is unknown (with the known ones), when the file is
/// missing, not a regular file, unreadable, cut off, or without triangles, when it has no such part
/// (with the nearest name), when both `part` and `shape_index` are given or its format counts no
/// meshes, and when it names a vertex that is missing or not finite.
TriangleMesh read_mesh_file(const Mesh::Settings& settings);

}  // namespace pharos

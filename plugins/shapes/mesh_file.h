#pragma once

#include <pharos/scene/shape.h>

#include "mesh.h"

namespace pharos {

/// Reads the triangles that the settings of a mesh select, in world space, with the requested
/// normals. The meshes of the file are joined, with the transforms of its nodes applied. By default
/// all meshes are read. If `part` is not empty, the meshes of that name and everything at or below
/// the nodes of that name are read; if `shape_index` is set, the mesh of that number. If only some
/// meshes have normals or texture coordinates, the others get zeros. A file packed by gzip, such as
/// `mesh.ply.gz`, is unpacked first. Texture coordinates have their
/// origin at the lower left of the image. Throws InputError with the path in these cases: the
/// format is unknown (the message lists the known formats); the file is missing, not a regular
/// file, unreadable, truncated, or without triangles; it has no such part (the message names the
/// nearest name); both `part` and `shape_index` are given; the format does not number its meshes; a
/// used vertex is missing or not finite.
TriangleMesh read_mesh_file(const Mesh::Settings& settings);

}  // namespace pharos

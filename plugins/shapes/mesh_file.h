#pragma once

#include <filesystem>

#include <pharos/scene/shape.h>

namespace pharos {

/// All triangles of a file, in its own space; without its normals if `face_normals`. Meshes without
/// normals or texture coordinates, in a file where others have them, get zeros. Throws InputError
/// with the path when the file is missing, unreadable, cut off, without triangles, or holds numbers
/// that are not finite.
TriangleMesh read_mesh_file(const std::filesystem::path& path, bool face_normals);

}  // namespace pharos

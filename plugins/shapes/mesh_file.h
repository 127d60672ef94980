#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pharos/scene/shape.h>

namespace pharos {

/// The triangles of a file in the space of its root, with the transforms of its nodes applied:
/// those of all its meshes or, unless `part` is empty, of the meshes of that name and of all that
/// lies at or below the nodes of that name, or of the mesh of number `index`. Without the file's
/// normals if `face_normals`. Meshes without normals or texture coordinates, where others have
/// them, get zeros. Texture coordinates have their origin at the picture's lower left. Throws
/// InputError with the path when the format is unknown (with the known ones), when the file is
/// missing, not a regular file, unreadable, cut off, or without triangles, when it has no such part
/// (with the nearest name), when both `part` and `index` are given or its format counts no meshes,
/// and when it names a vertex that is missing or not finite.
TriangleMesh read_mesh_file(const std::filesystem::path& path, const std::string& part,
                            bool face_normals, std::optional<int> index = {});

}  // namespace pharos

#pragma once

#include <string_view>

#include <pharos/scene/shape.h>

namespace pharos {

/// Reads the triangles of `text`, a whole PLY file, text or binary of either byte order. Polygons
/// are assumed to be convex and become triangle fans. All properties are ignored except positions
/// (x y z), normals (nx ny nz), texture coordinates (u v or s t, also with the prefix "texture_")
/// and vertex indices. Throws InputError, without the file's name, if the text is not PLY, is
/// truncated, contains numbers that are not finite, or lacks vertices. The message names the faulty
/// vertex or face.
TriangleMesh read_ply(std::string_view text);

}  // namespace pharos

#pragma once

#include <string_view>

#include <pharos/scene/shape.h>

namespace pharos {

/// The triangles of `text`, a whole PLY file, text or binary of either byte order. Polygons, which
/// are taken to be convex, become fans; all properties but positions (x y z), normals (nx ny nz),
/// texture coordinates (u v or s t, also with "texture_" before) and vertex indices are passed
/// over. Throws InputError, without the file's name, for what is not PLY, cut off, not finite or
/// without its vertices, saying which vertex or face is to blame.
TriangleMesh read_ply(std::string_view text);

}  // namespace pharos

#pragma once

#include <filesystem>

namespace pharos::mitsuba {

/// False when a mesh file, OBJ or PLY by its extension, has no normals at its vertices. True for
/// what cannot be read: the mesh itself says what is wrong.
bool has_vertex_normals(const std::filesystem::path& file);

}  // namespace pharos::mitsuba

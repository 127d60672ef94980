#pragma once

#include <pharos/scene/shape.h>

namespace pharos {

/// The same triangles with each vertex stored once: those that agree in every bit of position,
/// normal and texture coordinates become one, those that no triangle names are left out. Readers of
/// some formats give every face vertices of its own. Throws InputError unless there are as many
/// normals as vertices, or none, and likewise for texture coordinates.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace pharos

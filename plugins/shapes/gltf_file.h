#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// Reads the triangles of a glTF 2.0 file, text or binary (GLB). It reads the default scene, or
/// else the first scene, and applies the transforms of all nodes. The nodes and meshes of the file
/// are its parts. Numbers of all glTF types are read, including those of KHR_mesh_quantization.
/// Skins, morph targets and animations are ignored. Throws InputError, with the place in the JSON,
/// if data is damaged, missing or sparse; if the file requires an extension that may affect its
/// triangles, such as compression; if its nodes do not form a tree of at most 500 levels; and if
/// there is no such part.
TriangleMesh read_gltf(const MeshSource& source);

}  // namespace pharos

#pragma once

#include <pharos/scene/shape.h>

#include "mesh_source.h"

namespace pharos {

/// The triangles of a glTF 2.0 file, text or binary (GLB), in its default scene or else its first
/// one, with the transforms of all nodes applied. Its nodes and meshes are its parts. Numbers of
/// every type that glTF has are read, also those of KHR_mesh_quantization; skins, morph targets and
/// animations are passed over. Throws InputError, with the place in the JSON, for what is damaged
/// or missing, or sparse, for extensions that the file needs and that may bear on its triangles,
/// such as compression, for nodes that form no tree or one of more than 500 levels, and when there
/// is no such part.
TriangleMesh read_gltf(const MeshSource& source);

}  // namespace pharos

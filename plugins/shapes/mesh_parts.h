#pragma once

#include <string>
#include <vector>

#include <assimp/scene.h>

#include <pharos/scene/shape.h>

/// A file's hierarchy of nodes, each of which places meshes and further nodes.
namespace pharos {

inline Vec3 to_vec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// The names of all meshes with triangles and of the nodes at or above them, sorted.
std::vector<std::string> part_names(const aiScene& scene);

/// The triangles of the part of that name, or of all if it is empty, in the space of the root. A
/// mesh counts once for each node that places it. Mirrored nodes keep the outer side outside.
TriangleMesh joined_part(const aiScene& scene, const std::string& part);

}  // namespace pharos

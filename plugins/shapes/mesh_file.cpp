#include "mesh_file.h"

#include <algorithm>
#include <span>
#include <string>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

Vec3 to_vec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw InputError("mesh '" + path.string() + "': " + reason);
}

std::span<aiMesh* const> meshes_of(const aiScene& scene) {
  return {scene.mMeshes, scene.mNumMeshes};
}

/// Assimp's later steps trust what its readers made of a damaged file, and crash on it.
void check_as_read(const std::filesystem::path& path, const aiScene& scene) {
  std::size_t faces = 0;
  for (const aiMesh* mesh : meshes_of(scene)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      for (const unsigned index : std::span(face.mIndices, face.mNumIndices)) {
        if (index >= mesh->mNumVertices) fail(path, "a face names a vertex that is missing");
      }
      faces += face.mNumIndices >= 3 ? 1 : 0;
    }
  }
  if (faces == 0) fail(path, "it holds no triangles");
}

/// Appends a mesh's vertices and triangles.
class Joiner {
 public:
  Joiner(const std::filesystem::path& path, TriangleMesh& result) : path_(path), result_(result) {}

  void add(const aiMesh& mesh, bool any_normals, bool any_uvs) {
    const auto first = static_cast<std::uint32_t>(result_.positions.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) add_vertex(mesh, i, any_normals, any_uvs);
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      if (face.mNumIndices != 3) continue;  // points and lines
      result_.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }

 private:
  void add_vertex(const aiMesh& mesh, unsigned i, bool any_normals, bool any_uvs) {
    const Point3 position = to_vec3(mesh.mVertices[i]);
    Vec3 normal, uv;
    if (any_normals && mesh.HasNormals()) normal = to_vec3(mesh.mNormals[i]);
    if (any_uvs && mesh.HasTextureCoords(0)) uv = to_vec3(mesh.mTextureCoords[0][i]);
    if (!is_finite(position) || !is_finite(normal) || !is_finite(uv)) {
      fail(path_, "vertex " + std::to_string(result_.positions.size()) + " is not finite");
    }
    result_.positions.push_back(position);
    if (any_normals) result_.normals.push_back(normal);
    if (any_uvs) result_.uvs.push_back({uv.x, uv.y});
  }

  const std::filesystem::path& path_;
  TriangleMesh& result_;
};

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path, bool face_normals) {
  if (!std::filesystem::is_regular_file(path)) fail(path, "there is no such file");
  Assimp::Importer importer;
  const int unused = aiComponent_COLORS | aiComponent_TANGENTS_AND_BITANGENTS |
                     aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                     aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS |
                     (face_normals ? int{aiComponent_NORMALS} : 0);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unused);
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) fail(path, importer.GetErrorString());
  check_as_read(path, *scene);
  scene = importer.ApplyPostProcessing(aiProcess_RemoveComponent | aiProcess_Triangulate |
                                       aiProcess_JoinIdenticalVertices |
                                       aiProcess_PreTransformVertices);
  if (scene == nullptr) fail(path, importer.GetErrorString());
  const auto meshes = meshes_of(*scene);
  const bool any_normals =
      !face_normals &&
      std::any_of(meshes.begin(), meshes.end(), [](const aiMesh* m) { return m->HasNormals(); });
  const bool any_uvs = std::any_of(meshes.begin(), meshes.end(),
                                   [](const aiMesh* m) { return m->HasTextureCoords(0); });
  TriangleMesh result;
  Joiner joiner(path, result);
  for (const aiMesh* mesh : meshes) joiner.add(*mesh, any_normals, any_uvs);
  return result;
}

}  // namespace pharos

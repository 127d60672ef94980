#include "mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <pharos/core/error.h>

#include "mesh_parts.h"
#include "ply_file.h"
#include "weld.h"

namespace pharos {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw InputError("mesh '" + path.string() + "': " + one_line(reason));
}

void check_is_file(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!exists(status)) fail(path, "there is no such file" + file_suggestion(path));
  if (!is_regular_file(status)) fail(path, "it is not a regular file");
}

/// Opens nothing but regular files: a mesh file may name others, and reading a device or a pipe
/// would never end.
class RegularFiles : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed)) return nullptr;
    return DefaultIOSystem::Open(file, mode);
  }
};

std::span<aiMesh* const> meshes_of(const aiScene& scene) {
  return {scene.mMeshes, scene.mNumMeshes};
}

std::string vertex_name(const aiMesh& mesh, std::size_t vertex) {
  const std::string where =
      mesh.mName.length > 0 ? fmt::format(" of '{}'", mesh.mName.C_Str()) : "";
  return fmt::format("vertex {}{}", vertex, where);
}

void check_vertices(const std::filesystem::path& path, const aiMesh& mesh) {
  for (std::size_t i = 0; i < mesh.mNumVertices; ++i) {
    const bool finite =
        is_finite(to_vec3(mesh.mVertices[i])) &&
        (!mesh.HasNormals() || is_finite(to_vec3(mesh.mNormals[i]))) &&
        (!mesh.HasTextureCoords(0) || is_finite(to_vec3(mesh.mTextureCoords[0][i])));
    if (!finite) fail(path, vertex_name(mesh, i) + " is not finite");
  }
}

/// Assimp's later steps trust what its readers made of a damaged file, and crash on it.
void check_as_read(const std::filesystem::path& path, const aiScene& scene) {
  for (const aiMesh* mesh : meshes_of(scene)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      if (face.mNumIndices == 0) fail(path, "it has a face without vertices");
      for (const unsigned index : std::span(face.mIndices, face.mNumIndices)) {
        if (index < mesh->mNumVertices) continue;
        fail(path, "a face names " + vertex_name(*mesh, index) + ", which is missing");
      }
    }
    check_vertices(path, *mesh);
  }
}

const aiScene& import(Assimp::Importer& importer, const std::filesystem::path& path) {
  importer.SetIOHandler(new RegularFiles);  // which the importer owns
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) fail(path, importer.GetErrorString());
  check_as_read(path, *scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) fail(path, importer.GetErrorString());
  return *scene;
}

/// The part of that name by Assimp.
TriangleMesh read_part(const std::filesystem::path& path, const std::string& part) {
  Assimp::Importer importer;
  const aiScene& scene = import(importer, path);
  const std::vector<std::string> names = part_names(scene);
  if (!part.empty() && std::find(names.begin(), names.end(), part) == names.end()) {
    fail(path, fmt::format("it has no part '{}'{}; its parts are {}", part, suggestion(part, names),
                           quoted_list(names)));
  }
  return joined_part(scene, part);
}

bool is_ply(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".ply";
}

TriangleMesh read_ply_file(const std::filesystem::path& path, const std::string& part) {
  if (!part.empty()) fail(path, "PLY files have no parts");
  std::ifstream file(path, std::ios::binary);
  std::string text(std::filesystem::file_size(path), '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(text.size()))) {
    fail(path, "it cannot be read");
  }
  try {
    return read_ply(text);
  } catch (const InputError& e) {
    fail(path, e.what());
  }
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path, const std::string& part,
                            bool face_normals) {
  check_is_file(path);
  TriangleMesh mesh = is_ply(path) ? read_ply_file(path, part) : read_part(path, part);
  if (mesh.triangles.empty()) fail(path, "it holds no triangles");
  if (face_normals) mesh.normals.clear();
  return welded(mesh);
}

}  // namespace pharos

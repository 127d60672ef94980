#include "mesh_parts.h"

#include <set>
#include <span>
#include <utility>

#include "triangle_shape.h"

namespace pharos {
namespace {

std::string name_of(const aiString& text) {
  return {text.data, text.length};
}

bool has_triangles(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0;
}

/// The meshes that a node places itself.
std::vector<const aiMesh*> meshes_at(const aiNode& node, const aiScene& scene) {
  std::vector<const aiMesh*> meshes;
  for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
    if (has_triangles(*scene.mMeshes[index])) meshes.push_back(scene.mMeshes[index]);
  }
  return meshes;
}

std::span<aiNode* const> children_of(const aiNode& node) {
  return {node.mChildren, node.mNumChildren};
}

/// Adds the names at and below `node`; true when there are triangles.
bool collect_names(const aiNode& node, const aiScene& scene, std::set<std::string>& names) {
  const auto meshes = meshes_at(node, scene);
  bool any = !meshes.empty();
  for (const aiMesh* mesh : meshes) names.insert(name_of(mesh->mName));
  for (const aiNode* child : children_of(node)) any |= collect_names(*child, scene, names);
  if (any) names.insert(name_of(node.mName));
  return any;
}

/// The linear part of a node's map, with what points, normals and orientation need.
class Placement {
 public:
  explicit Placement(const aiMatrix4x4& m)
      : x_(m.a1, m.b1, m.c1),
        y_(m.a2, m.b2, m.c2),
        z_(m.a3, m.b3, m.c3),
        origin_(m.a4, m.b4, m.c4),
        mirrors_(dot(x_, cross(y_, z_)) < 0) {}

  Point3 point(Point3 p) const { return p.x * x_ + p.y * y_ + p.z * z_ + origin_; }
  /// By the cofactors, which are the inverse transpose times the determinant and exist for maps
  /// that flatten space too.
  Vec3 normal(Vec3 n) const {
    const Vec3 v = n.x * cross(y_, z_) + n.y * cross(z_, x_) + n.z * cross(x_, y_);
    return mirrors_ ? -v : v;
  }
  bool mirrors() const { return mirrors_; }

 private:
  Vec3 x_, y_, z_;
  Point3 origin_;
  bool mirrors_;
};

/// Appends the meshes of a part.
class Joiner {
 public:
  Joiner(const aiScene& scene, const std::string& part) : scene_(scene), part_(part) {}

  /// `selected`: whether a node above belongs to the part already.
  void add(const aiNode& node, const aiMatrix4x4& parent, bool selected) {
    const aiMatrix4x4 to_root = parent * node.mTransformation;
    selected = selected || name_of(node.mName) == part_;
    for (const aiMesh* mesh : meshes_at(node, scene_)) {
      if (selected || name_of(mesh->mName) == part_) chosen_.push_back({mesh, Placement(to_root)});
    }
    for (const aiNode* child : children_of(node)) add(*child, to_root, selected);
  }

  TriangleMesh join() {
    std::size_t faces = 0, vertices = 0;
    for (const auto& [mesh, placement] : chosen_) {
      faces += mesh->mNumFaces;
      vertices += mesh->mNumVertices;
      any_normals_ = any_normals_ || mesh->HasNormals();
      any_uvs_ = any_uvs_ || mesh->HasTextureCoords(0);
    }
    check_triangle_count(static_cast<double>(faces), "mesh");
    result_.triangles.reserve(faces);
    result_.positions.reserve(vertices);
    if (any_normals_) result_.normals.reserve(vertices);
    if (any_uvs_) result_.uvs.reserve(vertices);
    for (const auto& [mesh, placement] : chosen_) append(*mesh, placement);
    return std::move(result_);
  }

 private:
  void append(const aiMesh& mesh, const Placement& placement) {
    const auto first = static_cast<std::uint32_t>(result_.positions.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) append_vertex(mesh, i, placement);
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      if (face.mNumIndices != 3) continue;  // points and lines
      auto& corners = result_.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) corners[i] = first + face.mIndices[i];
      if (placement.mirrors()) std::swap(corners[1], corners[2]);
    }
  }

  void append_vertex(const aiMesh& mesh, unsigned i, const Placement& placement) {
    result_.positions.push_back(placement.point(to_vec3(mesh.mVertices[i])));
    if (any_normals_) {
      result_.normals.push_back(mesh.HasNormals() ? placement.normal(to_vec3(mesh.mNormals[i]))
                                                  : Vec3{});
    }
    if (any_uvs_) {
      const Vec3 uv = mesh.HasTextureCoords(0) ? to_vec3(mesh.mTextureCoords[0][i]) : Vec3{};
      result_.uvs.push_back({uv.x, uv.y});
    }
  }

  const aiScene& scene_;
  const std::string& part_;
  std::vector<std::pair<const aiMesh*, Placement>> chosen_;
  bool any_normals_ = false, any_uvs_ = false;
  TriangleMesh result_;
};

}  // namespace

std::vector<std::string> part_names(const aiScene& scene) {
  std::set<std::string> names;
  collect_names(*scene.mRootNode, scene, names);
  names.erase("");
  return {names.begin(), names.end()};
}

TriangleMesh joined_part(const aiScene& scene, const std::string& part) {
  Joiner joiner(scene, part);
  joiner.add(*scene.mRootNode, {}, part.empty());
  return joiner.join();
}

}  // namespace pharos

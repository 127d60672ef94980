#include "gltf_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "gltf_node.h"
#include "gltf_primitive.h"
#include "triangle_shape.h"

namespace pharos {
namespace {

constexpr int kMostLevels = 500;

/// Prefixes of the extensions that are read, or that do not affect the triangles. Any other
/// extension that a file requires may place, hide or encode triangles.
constexpr std::array<std::string_view, 9> kHarmless{
    "KHR_mesh_quantization", "KHR_materials_", "KHR_texture_", "KHR_lights_",  "KHR_xmp",
    "EXT_materials_",        "EXT_texture_",   "EXT_lights_",  "MSFT_texture_"};

struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;  ///< the primitives that have triangles
  MeshExtent extent;
};

GltfMesh read_mesh(GltfFile& file, const GltfValue& mesh) {
  GltfMesh result{.name = mesh.text("name", "")};
  const GltfValue primitives = mesh.member("primitives");
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    GltfPrimitive primitive(file, primitives.item(i));
    if (primitive.extent().triangles == 0) continue;
    result.extent += primitive.extent();
    result.primitives.push_back(std::move(primitive));
  }
  return result;
}

/// Returns an empty mesh with enough capacity for `extent`.
TriangleMesh with_room(const MeshExtent& extent) {
  check_triangle_count(extent.triangles, "it");
  const auto vertices = static_cast<std::size_t>(extent.vertices);
  TriangleMesh mesh;
  mesh.triangles.reserve(static_cast<std::size_t>(extent.triangles));
  mesh.positions.reserve(vertices);
  if (extent.attributes.normals) mesh.normals.reserve(vertices);
  if (extent.attributes.uvs) mesh.uvs.reserve(vertices);
  return mesh;
}

void check_supported(const GltfValue& root) {
  const std::string version = root.member("asset").member("version").text();
  if (!version.starts_with("2.")) {
    throw InputError(fmt::format("it is glTF {}; known is 2.0", one_line(version, 20)));
  }
  if (!root.has("extensionsRequired")) return;
  const GltfValue required = root.member("extensionsRequired");
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string name = required.item(i).text();
    const bool harmless = std::any_of(kHarmless.begin(), kHarmless.end(),
                                      [&](auto prefix) { return name.starts_with(prefix); });
    if (!harmless) {
      throw InputError(fmt::format("it needs '{}', which is not read", one_line(name, 60)));
    }
  }
}

/// Visits the nodes of a scene and joins the meshes that belong to the part.
class SceneReader {
 public:
  SceneReader(GltfFile& file, const std::string& part) : file_(file), part_(part) {}

  TriangleMesh read() {
    const GltfValue roots = scene().member("nodes");
    for (std::size_t i = 0; i < roots.size(); ++i) {
      visit(roots.item(i), {}, part_.empty(), 1);
    }
    names_.erase("");
    check_part(part_, names_);
    return joined();
  }

 private:
  /// A mesh with the transform of its node.
  struct Placed {
    const GltfMesh& mesh;
    NodeTransform to_root;
  };

  GltfValue scene() const {
    const GltfValue root = file_.document.root();
    if (root.has("scene")) return file_.document.referenced(root.member("scene"), "scenes");
    return root.member("scenes").item(0);
  }

  /// Returns true if there are triangles at or below the node. `selected` states whether a node
  /// above belongs to the part.
  bool visit(const GltfValue& reference, const NodeTransform& parent, bool selected, int level) {
    const GltfValue node = file_.document.referenced(reference, "nodes");
    if (!visited_.insert(node.place()).second)
      node.fail("is reached twice; nodes must form a tree");
    if (level > kMostLevels) node.fail(fmt::format("lies deeper than {} levels", kMostLevels));
    const NodeTransform to_root = parent * node_transform(node);
    const std::string name = node.text("name", "");
    selected = selected || name == part_;
    bool any = node.has("mesh") && place(mesh(node.member("mesh")), to_root, selected);
    if (node.has("children")) {
      const GltfValue children = node.member("children");
      for (std::size_t i = 0; i < children.size(); ++i) {
        any |= visit(children.item(i), to_root, selected, level + 1);
      }
    }
    if (any) names_.insert(name);
    return any;
  }

  /// Returns true if the mesh has triangles.
  bool place(const GltfMesh& mesh, const NodeTransform& to_root, bool selected) {
    if (mesh.primitives.empty()) return false;
    names_.insert(mesh.name);
    if (selected || mesh.name == part_) placed_.push_back({mesh, to_root});
    return true;
  }

  const GltfMesh& mesh(const GltfValue& reference) {
    const GltfValue mesh = file_.document.referenced(reference, "meshes");
    const auto known = meshes_.find(mesh.place());
    if (known != meshes_.end()) return known->second;
    return meshes_.emplace(mesh.place(), read_mesh(file_, mesh)).first->second;
  }

  TriangleMesh joined() const {
    MeshExtent extent;
    for (const Placed& placed : placed_) extent += placed.mesh.extent;
    TriangleMesh mesh = with_room(extent);
    for (const Placed& placed : placed_) {
      for (const GltfPrimitive& primitive : placed.mesh.primitives) {
        primitive.append_to(mesh, placed.to_root, extent.attributes);
      }
    }
    return mesh;
  }

  GltfFile& file_;
  const std::string& part_;
  std::map<std::string, GltfMesh> meshes_;  ///< read so far, by place
  std::set<std::string> visited_;           ///< nodes by place
  std::set<std::string> names_;             ///< names of nodes and meshes with triangles
  std::vector<Placed> placed_;              ///< the meshes of the part
};

}  // namespace

TriangleMesh read_gltf(const MeshSource& source) {
  const GltfChunks chunks = gltf_chunks(source.bytes);
  const std::string text_file = chunks.is_glb ? "" : source.path.string();
  GltfFile file{GltfDocument(chunks.json, text_file),
                GltfBuffers(chunks, source.path.parent_path())};
  check_supported(file.document.root());
  return SceneReader(file, source.part).read();
}

}  // namespace pharos

#include "mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <new>
#include <pbrt_syntax/gzip.h>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>
#include <pharos/core/packed_name.h>

#include "gltf_file.h"
#include "mesh_source.h"
#include "obj_file.h"
#include "pbrt_mesh.h"
#include "ply_file.h"
#include "serialized_file.h"
#include "stl_file.h"
#include "triangle_shape.h"
#include "vertex_normals.h"
#include "weld.h"

namespace pharos {
namespace {

struct Format {
  std::string_view extension;
  bool has_parts, has_numbers;
  TriangleMesh (*read)(const MeshSource&);
};
constexpr std::array<Format, 7> kFormats{
    {{".glb", true, false, read_gltf},
     {".gltf", true, false, read_gltf},
     {".obj", true, false, read_obj},
     {".pbrt", true, false, read_pbrt_mesh},
     {".ply", false, false, [](const MeshSource& source) { return read_ply(source.bytes); }},
     {".serialized", true, true, read_serialized},
     // In STL files every triangle has its own vertices.
     {".stl", false, false, [](const MeshSource& source) { return welded(read_stl(source)); }}}};

const Format& format_of(const std::filesystem::path& path) {
  std::string extension = unpacked_name(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::vector<std::string> known;
  for (const Format& format : kFormats) {
    if (format.extension == extension) return format;
    known.emplace_back(format.extension);
  }
  throw InputError(fmt::format("the format '{}' is not known{}; known are {}", extension,
                               suggestion(extension, known), quoted_list(known)));
}

/// Reads a file, and unpacks it if it is packed. A small file that claims to hold much is refused.
std::string read_unpacked(const std::filesystem::path& path) {
  constexpr std::size_t kMostGrowth = 100, kAlwaysPossible = std::size_t{16} << 20;  // [bytes]
  std::string bytes = read_regular_file(path);
  const std::size_t most = std::max(kAlwaysPossible, kMostGrowth * bytes.size());
  return pbrt::unpacked(std::move(bytes), most);
}

/// Reads the mesh with the vertices that its triangles share in the file.
TriangleMesh read_triangles(const Mesh::Settings& settings) {
  const std::filesystem::path& path = settings.file;
  const std::string& part = settings.part;
  const std::optional<int> index = settings.shape_index;
  const Format& format = format_of(path);
  if (!part.empty() && !format.has_parts) {
    throw InputError(fmt::format("{} files have no parts", format.extension));
  }
  if (index && !format.has_numbers) {
    throw InputError(fmt::format("{} files do not number their meshes", format.extension));
  }
  if (index && !part.empty()) throw InputError("'part' and 'shape_index' exclude each other");
  const std::string bytes = read_unpacked(path);
  TriangleMesh mesh = format.read({path, bytes, part, index});
  if (mesh.triangles.empty()) throw InputError("it holds no triangles");
  return mesh;
}

/// Transforms the mesh to world space. Angles are measured there, on the visible surface.
TriangleMesh placed(TriangleMesh local, const Mesh::Settings& settings) {
  if (settings.normals == MeshNormals::flat) local.normals.clear();
  TriangleMesh mesh = transformed(std::move(local), settings.to_world, settings.flip_normals);
  if (settings.normals == MeshNormals::file_or_smooth) add_vertex_normals(mesh);
  return mesh;
}

}  // namespace

TriangleMesh read_mesh_file(const Mesh::Settings& settings) {
  const auto fail = [&](const std::string& reason) {
    throw InputError("mesh '" + settings.file.string() + "': " + one_line(reason, 1000));
  };
  try {
    return welded(placed(read_triangles(settings), settings));
  } catch (const InputError& e) {
    if (e.located()) throw;
    fail(e.what());
  } catch (const std::bad_alloc&) {
    fail("it does not fit into memory");
  }
  return {};
}

}  // namespace pharos
